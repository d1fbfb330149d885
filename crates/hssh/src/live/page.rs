//! The page that shows a map as it grows.

use hssh::pipeline::{Input, Mapped};

use super::hub::Hub;

/// The page before anything has come.
pub(crate) fn html(name: &str) -> String {
    format!("<!doctype html><title>{name}</title>")
}

/// Shows a map, or why there is none.
pub(crate) fn show(hub: &Hub, found: Result<(&Input, &Mapped), &str>) {
    match found {
        Ok((input, mapped)) => {
            let poses = mapped.scan_poses(input, 1);
            let anchor = poses.and_then(|poses| Some((poses.len() - 1, *poses.last()?)));
            hub.show_page(serde_json::to_string(&mapped.answer).unwrap_or_default(), anchor);
        }
        Err(reason) => hub.show_page(format!("{{\"reason\": {reason:?}}}"), None),
    }
}
