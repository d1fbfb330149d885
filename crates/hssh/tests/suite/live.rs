//! Mapping while a robot drives: in the end the answer is that of the log as a whole, however it came, and whoever ends it.

use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::path::PathBuf;
use std::process::{Child, Command, Output, Stdio};
use std::thread::sleep;
use std::time::Duration;

use serde_json::Value;

use super::common::{hssh, root, scratch, text};

/// A drive once around a ring, and a bit farther: the file, and its text.
fn ring(folder: &str) -> (PathBuf, String) {
    let log = scratch(folder).join("ring.log");
    let drive = hssh(&["simulate", "--floor", "ring", "--seed", "3", "-o", log.to_str().unwrap()]);
    assert!(log.is_file(), "{}", text(&drive.stderr));
    let content = std::fs::read_to_string(&log).unwrap();
    (log, content)
}

/// The program, fed by a pipe; with the address of its page.
struct Live {
    program: Child,
    address: String,
}

impl Live {
    fn start(arguments: &[&str]) -> Self {
        let mut program = Command::new(env!("CARGO_BIN_EXE_hssh"));
        program.current_dir(root()).args(["live", "-"]).args(arguments);
        let mut program =
            program.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        // What else it says is read when it has ended.
        let mut line = String::new();
        let mut said = BufReader::with_capacity(1, program.stderr.take().unwrap());
        said.read_line(&mut line).unwrap();
        program.stderr = Some(said.into_inner());
        let address = line.split("http://").nth(1).expect(&line).split('/').next().unwrap().to_owned();
        Live { program, address }
    }

    fn feed(&mut self, text: &str) {
        self.program.stdin.as_mut().unwrap().write_all(text.as_bytes()).unwrap();
    }

    fn end(mut self) -> Output {
        drop(self.program.stdin.take());
        self.program.wait_with_output().unwrap()
    }

    fn ask(&self, path: &str, host: &str) -> TcpStream {
        let mut stream = TcpStream::connect(&self.address).unwrap();
        stream.set_read_timeout(Some(Duration::from_secs(30))).unwrap();
        write!(stream, "GET {path} HTTP/1.1\r\nHost: {host}\r\nConnection: close\r\n\r\n").unwrap();
        stream
    }
}

/// An answer but for what it was called and how long it took.
fn answer(output: &Output) -> Value {
    let mut answer: Value =
        serde_json::from_slice(&output.stdout).unwrap_or_else(|_| panic!("{}", text(&output.stderr)));
    answer["input"]["name"] = Value::Null;
    answer["search"]["seconds"] = Value::Null;
    answer
}

#[test]
fn what_comes_in_pieces_is_mapped_as_a_whole() {
    let (file, content) = ring("live");
    let whole = answer(&hssh(&["map", file.to_str().unwrap(), "--planar", "--json"]));
    let mut live = Live::start(&["--planar", "--json"]);
    let lines: Vec<&str> = content.split_inclusive('\n').collect();
    for piece in lines.chunks(lines.len() / 7) {
        let text = piece.concat();
        // Not every piece ends with a line.
        let (one, other) = text.split_at(text.len() / 2);
        live.feed(one);
        sleep(Duration::from_millis(60));
        live.feed(other);
    }
    let output = live.end();
    assert_eq!(answer(&output), whole, "{}", text(&output.stderr));
    let said = text(&output.stderr);
    assert!(
        said.contains(&format!("{} scans were in the picture", content.matches("FLASER").count())),
        "{said}"
    );
}

#[test]
fn the_page_is_served_to_this_machine_alone() {
    let (_, content) = ring("live-page");
    let mut live = Live::start(&["--planar"]);
    let own = live.address.clone();
    let read = |mut stream: TcpStream| {
        let mut answer = String::new();
        stream.read_to_string(&mut answer).unwrap();
        answer
    };
    assert!(read(live.ask("/", &own)).starts_with("HTTP/1.1 200"));
    assert!(read(live.ask("/", "somebody.example")).starts_with("HTTP/1.1 403"));
    assert!(read(live.ask("/etc/passwd", &own)).starts_with("HTTP/1.1 404"));
    let events = BufReader::new(live.ask("/events", &own));
    live.feed(&content);
    let mut robot = false;
    for line in events.lines().map(Result::unwrap) {
        let Some(data) = line.strip_prefix("data: ") else { continue };
        let data: Value = serde_json::from_str(data).expect(data);
        robot |= data["pose"].is_array() && data["hits"].as_array().is_some_and(|hits| !hits.is_empty());
        if data["maps"].as_array().is_some_and(|maps| !maps.is_empty()) {
            break;
        }
    }
    assert!(robot, "the robot is shown before the map");
    assert!(live.end().status.success());
}

#[cfg(unix)]
#[test]
fn whoever_ends_it_gets_all_that_is_known() {
    let (_, content) = ring("live-end");
    let trajectory = scratch("live-end").join("way.tum");
    let _ = std::fs::remove_file(&trajectory);
    let mut live = Live::start(&["--planar", "--trajectory", trajectory.to_str().unwrap()]);
    live.feed(&content);
    sleep(Duration::from_millis(1500));
    let sent = Command::new("kill").args(["-INT", &live.program.id().to_string()]).status().unwrap();
    assert!(sent.success());
    let pipe = live.program.stdin.take();
    let output = live.program.wait_with_output().unwrap();
    drop(pipe);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let poses = std::fs::read_to_string(&trajectory).unwrap().lines().count();
    assert!(poses > 0 && poses <= content.matches("FLASER").count(), "{poses}");
}

#[test]
fn lines_of_json_are_a_log_like_any_other() {
    let (file, content) = ring("live-json");
    let lines: Vec<String> = content.lines().filter_map(as_json).collect();
    let json = file.with_extension("jsonl");
    std::fs::write(&json, lines.concat()).unwrap();
    let whole = answer(&hssh(&["map", json.to_str().unwrap(), "--planar", "--json"]));
    assert_eq!(whole["maps"][0]["places"].as_array().unwrap().len(), 4);
    let mut live = Live::start(&["--planar", "--json"]);
    for piece in lines.chunks(50) {
        live.feed(&piece.concat());
        sleep(Duration::from_millis(5));
    }
    assert_eq!(answer(&live.end()), whole);
}

/// A message of a CARMEN log as a line of JSON.
fn as_json(line: &str) -> Option<String> {
    let words: Vec<&str> = line.split_whitespace().collect();
    let numbers = |range: std::ops::Range<usize>| words[range].join(", ");
    let time = words.last()?;
    match *words.first()? {
        "FLASER" => {
            let beams: usize = words[1].parse().unwrap();
            let (ranges, pose) = (numbers(2..2 + beams), numbers(5 + beams..8 + beams));
            let step = std::f64::consts::PI / (beams - beams % 2) as f64;
            Some(format!(
                "{{\"time\": {time}, \"pose\": [{pose}], \"angle_min\": {}, \"angle_increment\": {step}, \"ranges\": [{ranges}]}}\n",
                -std::f64::consts::FRAC_PI_2
            ))
        }
        _ => None,
    }
}

#[test]
fn what_is_no_stream_is_refused() {
    let refused = |fed: &str| {
        let mut live = Live::start(&[]);
        live.feed(fed);
        let output = live.end();
        assert_eq!(output.status.code(), Some(2));
        text(&output.stderr)
    };
    assert!(
        refused("Exploration(stars: {})\n").contains("is an exploration, but this command takes messages")
    );
    assert!(refused("EDGE_SE2 0 1 1 0 0 1 0 0 1 0 1\n").contains("is a pose graph"));
    assert!(refused("").contains("is empty"));
    assert!(refused("FLASER 3 1 2\n").contains("no usable laser scan"));
    assert!(refused("{\"time\": 1, \"pose\": [0, 0, 0]}\n").contains("none of 1 lines is a scan"));
}
