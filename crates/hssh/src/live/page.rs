//! The page that shows a map as it grows.

use hssh::page::PageData;
use hssh::pipeline::{Input, Mapped};

use super::hub::Hub;
use super::server::EVENTS;

/// The page before anything has come.
pub(crate) fn html(name: &str) -> String {
    PageData::waiting(name, EVENTS, "nothing has come that a map could be made of").to_html()
}

/// Shows a map, or why there is none.
pub(crate) fn show(hub: &Hub, found: Result<(&Input, &Mapped), &str>) {
    let page = found.map_err(str::to_owned).and_then(|(input, mapped)| {
        let page = PageData::without_history(input, mapped, 1).map_err(|error| error.to_string())?;
        let poses = mapped.scan_poses(input, 1);
        Ok((page, poses.and_then(|poses| Some((poses.len() - 1, *poses.last()?)))))
    });
    match page {
        Ok((page, anchor)) => hub.show_page(page.to_json(), anchor),
        Err(reason) => hub.show_page(serde_json::json!({ "waiting": reason }).to_string(), None),
    }
}
