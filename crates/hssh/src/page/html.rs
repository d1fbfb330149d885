//! Pages as text: a frame, one style, one script, and the data between them. Nothing of the input gets into a page but as data.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use sha2::{Digest as _, Sha256};

/// What a page is before there are data.
pub(super) struct Template {
    /// The elements, with a comment where something is put.
    frame: &'static str,
    style: &'static str,
    script: &'static str,
}

/// A script: functions by concept, in an order in which each is told before it is used, and one call.
macro_rules! script {
    ($($part:literal)*) => {
        concat!("\"use strict\";\n(() => {\n", $(include_str!(concat!("assets/js/", $part, ".js")),)* "})();\n")
    };
}

/// The elements of a page: the head that all pages share, and what is its own.
macro_rules! frame {
    ($body:literal) => {
        concat!(include_str!("assets/head.html"), include_str!(concat!("assets/", $body, ".html")))
    };
}

/// The page of an answer.
pub(super) const ANSWER: Template = Template {
    frame: frame!("page"),
    style: include_str!("assets/page.css"),
    script: script!(
        "elements" "words" "replay" "paths" "placement" "view" "star_picture" "camera" "map_picture" "map_card" "detail_card" "time_card"
        "ranking_card" "tree_card" "tables" "headline" "basis_card" "theme" "live" "main"
    ),
};

/// The page of a grid map.
pub(super) const PLAN: Template = Template {
    frame: frame!("plan"),
    style: concat!(include_str!("assets/page.css"), include_str!("assets/plan.css")),
    script: script!(
        "elements" "words" "star_picture" "camera" "plan_words" "plan_picture" "plan_detail" "plan_tables" "theme" "plan_main"
    ),
};

impl Template {
    /// The page of some data, which may ask the program that served it for news.
    pub(super) fn filled(&self, json: &str, asks: bool) -> String {
        let connect = if asks { "'self'" } else { "'none'" };
        let policy = format!(
            "default-src 'none'; img-src data:; style-src {}; script-src {}; connect-src {connect}; base-uri 'none'; form-action 'none'",
            hash(self.style),
            hash(self.script)
        );
        let parts = [
            ("<!-- policy -->", policy.as_str()),
            ("<!-- style -->", self.style),
            ("<!-- data -->", &harmless(json)),
            ("<!-- script -->", self.script),
        ];
        let (mut page, mut rest) = (String::new(), self.frame);
        for (mark, part) in parts {
            let (before, after) =
                rest.split_once(mark).expect("the frame has every mark once, in this order");
            page.push_str(before);
            page.push_str(part);
            rest = after;
        }
        page + rest
    }
}

/// The same JSON without any letter that could end the element it stands in, or begin another. These letters occur in texts only.
fn harmless(json: &str) -> String {
    json.replace('<', "\\u003c").replace('>', "\\u003e").replace('&', "\\u0026")
}

/// What a content security policy calls an inline style or script: nothing else is obeyed.
fn hash(text: &str) -> String {
    format!("'sha256-{}'", STANDARD.encode(Sha256::digest(text)))
}
