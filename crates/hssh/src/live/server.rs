//! Serves the page on this machine, and tells it what is new (server-sent events).

use std::io::{self, Write};
use std::net::Ipv4Addr;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::Duration;

use tiny_http::{Header, Method, Request, Response, Server};

use super::hub::Hub;

/// Where the page hears what is new.
pub(crate) const EVENTS: &str = "/events";
/// So often a connection shows that it is alive.
const HEARTBEAT: Duration = Duration::from_secs(10);
/// So often the server looks whether it is to stop.
const LOOK: Duration = Duration::from_millis(200);
/// No more pages are served at once.
const MOST_LISTENERS: usize = 32;

/// A server of this machine, until it is dropped.
pub(crate) struct PageServer {
    address: String,
    stop: Arc<AtomicBool>,
}

impl PageServer {
    /// Serves `html` and what the hub shows on a port of the loopback interface, 0 being any that is free.
    pub(crate) fn start(port: u16, html: String, hub: &Arc<Hub>) -> io::Result<Self> {
        let server = Server::http((Ipv4Addr::LOCALHOST, port)).map_err(io::Error::other)?;
        let port = server.server_addr().to_ip().map_or(port, |address| address.port());
        let stop = Arc::new(AtomicBool::new(false));
        let (stopped, hub) = (Arc::clone(&stop), Arc::clone(hub));
        thread::spawn(move || {
            let listeners = Arc::new(());
            while !stopped.load(Ordering::Relaxed) {
                if let Ok(Some(request)) = server.recv_timeout(LOOK) {
                    answer(request, port, &html, &hub, &listeners);
                }
            }
        });
        Ok(PageServer { address: format!("http://127.0.0.1:{port}/"), stop })
    }

    pub(crate) fn address(&self) -> &str {
        &self.address
    }
}

impl Drop for PageServer {
    fn drop(&mut self) {
        self.stop.store(true, Ordering::Relaxed);
    }
}

/// Answers one request. It does not matter whether anybody is still there to read it.
fn answer(request: Request, port: u16, html: &str, hub: &Arc<Hub>, listeners: &Arc<()>) {
    let is_own = |header: &Header| {
        let host = header.value.as_str();
        header.field.equiv("Host")
            && (host == format!("127.0.0.1:{port}") || host == format!("localhost:{port}"))
    };
    // A page of somebody else's may have its name lead here.
    if !request.headers().iter().any(is_own) {
        let _ = request.respond(Response::from_string("only for this machine").with_status_code(403));
        return;
    }
    let path = request.url().split('?').next().unwrap_or_default();
    match (request.method(), path) {
        (Method::Get | Method::Head, "/") => {
            let _ = request.respond(typed(html, "text/html; charset=utf-8"));
        }
        (Method::Get, EVENTS) if Arc::strong_count(listeners) <= MOST_LISTENERS => {
            let (hub, listener) = (Arc::clone(hub), Arc::clone(listeners));
            thread::spawn(move || {
                let _listener = listener;
                let _ = tell(request.into_writer(), &hub);
            });
        }
        (Method::Get, "/data.json") => {
            let _ = request.respond(typed(&hub.page().text, "application/json"));
        }
        _ => {
            let _ = request.respond(Response::from_string("not here").with_status_code(404));
        }
    }
}

fn typed(text: &str, kind: &str) -> Response<io::Cursor<Vec<u8>>> {
    let headers =
        [("Content-Type", kind), ("Cache-Control", "no-store"), ("X-Content-Type-Options", "nosniff")];
    let headers = headers.into_iter().filter_map(|(name, value)| Header::from_bytes(name, value).ok());
    headers.fold(Response::from_string(text), Response::with_header)
}

/// Tells a page what is new until one of both ends: messages are the data of a map, events `robot` say where the robot is, both as
/// JSON; `end` says that nothing more will come.
fn tell(mut page: Box<dyn Write + Send>, hub: &Hub) -> io::Result<()> {
    page.write_all(
        b"HTTP/1.1 200 OK\r\nContent-Type: text/event-stream\r\nCache-Control: no-store\r\nConnection: close\r\n\r\n",
    )?;
    page.flush()?;
    let mut seen = [0; 2];
    loop {
        let news = hub.news(seen, HEARTBEAT);
        let is_quiet = news.page.is_none() && news.robot.is_none();
        if let Some(shown) = news.page {
            seen[0] = shown.version;
            write!(page, "data: {}\n\n", shown.text)?;
        }
        if let Some(shown) = news.robot {
            seen[1] = shown.version;
            write!(page, "event: robot\ndata: {}\n\n", shown.text)?;
        }
        if is_quiet && news.has_ended {
            page.write_all(b"event: end\ndata: {}\n\n")?;
            return page.flush();
        }
        if is_quiet {
            page.write_all(b": still here\n\n")?;
        }
        page.flush()?;
    }
}
