//! XML, element by element, of whatever texts: what XML cannot say is replaced.

use std::borrow::Cow;

use quick_xml::Writer;
use quick_xml::events::{BytesDecl, BytesEnd, BytesStart, BytesText, Event};

/// A document that grows.
pub(super) struct XmlText(Writer<Vec<u8>>);

/// The name of an attribute, and its value.
type Attribute<'a> = (&'a str, &'a str);

impl XmlText {
    pub(super) fn new() -> Self {
        let mut text = XmlText(Writer::new_with_indent(Vec::new(), b' ', 2));
        text.event(Event::Decl(BytesDecl::new("1.0", Some("UTF-8"), None)));
        text
    }

    /// An element around what `inside` writes.
    pub(super) fn within(
        &mut self,
        name: &str,
        attributes: &[Attribute<'_>],
        inside: impl FnOnce(&mut Self),
    ) {
        self.event(Event::Start(start(name, attributes)));
        inside(self);
        self.event(Event::End(BytesEnd::new(name)));
    }

    /// An element without content.
    pub(super) fn empty(&mut self, name: &str, attributes: &[Attribute<'_>]) {
        self.event(Event::Empty(start(name, attributes)));
    }

    /// An element around a text.
    pub(super) fn element(&mut self, name: &str, attributes: &[Attribute<'_>], content: &str) {
        self.event(Event::Start(start(name, attributes)));
        self.event(Event::Text(BytesText::new(&sayable(content))));
        self.event(Event::End(BytesEnd::new(name)));
    }

    /// The document.
    pub(super) fn done(self) -> String {
        let mut text = String::from_utf8(self.0.into_inner()).expect("what is written is text");
        text.push('\n');
        text
    }

    fn event(&mut self, event: Event<'_>) {
        self.0.write_event(event).expect("there is always room in memory");
    }
}

fn start<'a>(name: &'a str, attributes: &[Attribute<'_>]) -> BytesStart<'a> {
    let mut start = BytesStart::new(name);
    for (name, value) in attributes {
        start.push_attribute((*name, sayable(value).as_ref()));
    }
    start
}

/// A text without the characters that XML 1.0 does not have, not even escaped.
fn sayable(text: &str) -> Cow<'_, str> {
    let is_sayable = |letter: char| match letter {
        '\t' | '\n' | '\r' => true,
        '\u{FFFE}' | '\u{FFFF}' => false,
        other => other >= ' ',
    };
    match text.chars().all(is_sayable) {
        true => Cow::Borrowed(text),
        false => Cow::Owned(
            text.chars()
                .map(|letter| if is_sayable(letter) { letter } else { char::REPLACEMENT_CHARACTER })
                .collect(),
        ),
    }
}
