//! The page as text: a frame, one style, one script, and the data between them. Nothing of the input gets into the page but as data.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use sha2::{Digest as _, Sha256};

use super::data::PageData;

/// What the page is before there are data, with a comment where something is put.
const FRAME: &str = include_str!("assets/page.html");

const STYLE: &str = include_str!("assets/page.css");

/// The script: functions by concept, in an order in which each is told before it is used, and one call.
const SCRIPT: &str = concat!(
    "\"use strict\";\n(() => {\n",
    include_str!("assets/js/elements.js"),
    include_str!("assets/js/words.js"),
    include_str!("assets/js/replay.js"),
    include_str!("assets/js/paths.js"),
    include_str!("assets/js/placement.js"),
    include_str!("assets/js/view.js"),
    include_str!("assets/js/star_picture.js"),
    include_str!("assets/js/map_picture.js"),
    include_str!("assets/js/map_card.js"),
    include_str!("assets/js/detail_card.js"),
    include_str!("assets/js/time_card.js"),
    include_str!("assets/js/ranking_card.js"),
    include_str!("assets/js/tree_card.js"),
    include_str!("assets/js/tables.js"),
    include_str!("assets/js/headline.js"),
    include_str!("assets/js/basis_card.js"),
    include_str!("assets/js/theme.js"),
    include_str!("assets/js/live.js"),
    include_str!("assets/js/main.js"),
    "})();\n"
);

/// The page of some data.
pub(super) fn page(data: &PageData) -> String {
    // Only a page that was served asks for news.
    let connect = if data.live.is_some() { "'self'" } else { "'none'" };
    let policy = format!(
        "default-src 'none'; img-src data:; style-src {}; script-src {}; connect-src {connect}; base-uri 'none'; form-action 'none'",
        hash(STYLE),
        hash(SCRIPT)
    );
    let parts = [
        ("<!-- policy -->", policy.as_str()),
        ("<!-- style -->", STYLE),
        ("<!-- data -->", &harmless(&data.to_json())),
        ("<!-- script -->", SCRIPT),
    ];
    let (mut page, mut rest) = (String::new(), FRAME);
    for (mark, part) in parts {
        let (before, after) = rest.split_once(mark).expect("the frame has every mark once, in this order");
        page.push_str(before);
        page.push_str(part);
        rest = after;
    }
    page + rest
}

/// The same JSON without any letter that could end the element it stands in, or begin another. These letters occur in texts only.
fn harmless(json: &str) -> String {
    json.replace('<', "\\u003c").replace('>', "\\u003e").replace('&', "\\u0026")
}

/// What a content security policy calls an inline style or script: nothing else is obeyed.
fn hash(text: &str) -> String {
    format!("'sha256-{}'", STANDARD.encode(Sha256::digest(text)))
}
