//! What a file is, told by what is in it: names and endings say nothing, and no two readers decide differently.

use std::fmt;

/// What a file holds.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum FileKind {
    /// An exploration as RON text.
    Exploration,
    /// A robot's laser log in CARMEN form; with its first message.
    LaserLog(String),
    /// A robot's recording by topics, and of which kind.
    Recording(&'static str),
    /// A table with the odometry and the ranges of a scan in each line.
    Table,
    /// Scans and odometry as JSON, an object a line.
    JsonLines,
    /// A pose graph: g2o, TORO, iSAM; with its first record.
    PoseGraph(String),
    /// The YAML file of a grid map.
    MapDescription,
    /// An image, and of which kind.
    Image(&'static str),
    /// What another command of hssh printed or wrote: of which format.
    Written(String),
    /// Something that hssh neither reads nor writes, and what.
    Foreign(&'static str),
    /// A compressed file, by what, and the program that unpacks it to standard output.
    Compressed(&'static str, &'static str),
    /// Text of no kind that is known.
    Text,
    /// Nothing.
    Empty,
}

impl FileKind {
    /// What a file is that begins so, after any byte order mark and compression by gzip have been taken off.
    ///
    /// ```
    /// use hssh::kind::FileKind;
    ///
    /// assert_eq!(FileKind::of(b"# a graph\nVERTEX_SE2 0 0 0 0\n"), FileKind::PoseGraph("VERTEX_SE2".into()));
    /// assert_eq!(FileKind::of(b"Exploration(stars: {}"), FileKind::Exploration);
    /// ```
    #[must_use]
    pub fn of(beginning: &[u8]) -> Self {
        if beginning.is_empty() {
            return FileKind::Empty;
        }
        if let Some(kind) = by_signature(beginning) {
            return kind;
        }
        if beginning.contains(&0) {
            return FileKind::Foreign("binary data");
        }
        of_text(&String::from_utf8_lossy(beginning))
    }

    /// Which command takes it, as an advice; empty if there is none.
    #[must_use]
    pub fn advice(&self) -> &'static str {
        match self {
            FileKind::Exploration => "`hssh map` maps an exploration, `hssh check` says what is in it",
            FileKind::LaserLog(_) => "`hssh map` maps a laser log, `hssh explore` makes an exploration of it",
            FileKind::Recording(_) => "`hssh check` says what is in a bag, `hssh map` maps it",
            FileKind::Table => "`hssh map` maps a table of scans, `hssh explore` makes an exploration of it",
            FileKind::JsonLines => "`hssh map` maps scans, `hssh explore` makes an exploration of them",
            FileKind::PoseGraph(_) => "`hssh graph` optimizes a pose graph",
            FileKind::MapDescription | FileKind::Image(_) => {
                "`hssh stars` finds the places of a grid map, `hssh simulate` drives through one"
            }
            FileKind::Written(format) if format == "hssh-certificate" => {
                "`hssh verify` takes a certificate and its exploration"
            }
            FileKind::Empty => "the program that should have written it may have failed",
            _ => "",
        }
    }
}

/// With its article, and what tells it.
impl fmt::Display for FileKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // A word of somebody else's file, for a terminal: short, and without control characters.
        let word = |word: &str| word.chars().take(40).flat_map(char::escape_debug).collect::<String>();
        match self {
            FileKind::Exploration => write!(f, "an exploration"),
            FileKind::LaserLog(first) => write!(f, "a laser log (its first message is `{}`)", word(first)),
            FileKind::Recording(what) => write!(f, "{what}"),
            FileKind::Table => write!(f, "a table of scans"),
            FileKind::JsonLines => write!(f, "scans as lines of JSON"),
            FileKind::PoseGraph(first) => write!(f, "a pose graph (its first record is `{}`)", word(first)),
            FileKind::MapDescription => write!(f, "the description of a grid map"),
            FileKind::Image(kind) => write!(f, "an image ({kind})"),
            FileKind::Written(format) => write!(f, "what hssh wrote ({})", word(format)),
            FileKind::Foreign(what) => write!(f, "{what}"),
            FileKind::Compressed(by, _) => write!(f, "compressed by {by}"),
            FileKind::Text => write!(f, "text of no kind that hssh knows"),
            FileKind::Empty => write!(f, "empty"),
        }
    }
}

/// What the first bytes alone say.
fn by_signature(beginning: &[u8]) -> Option<FileKind> {
    use FileKind::{Compressed, Image, Recording};
    let kind = match beginning {
        [b'P', b'1'..=b'6', space, ..] if space.is_ascii_whitespace() || *space == b'#' => {
            Image(["PBM", "PGM", "PPM", "PBM", "PGM", "PPM"][usize::from(beginning[1] - b'1')])
        }
        [0x89, b'P', b'N', b'G', ..] => Image("PNG"),
        [0xFF, 0xD8, 0xFF, ..] => Image("JPEG"),
        [b'I', b'I', 42, 0, ..] | [b'M', b'M', 0, 42, ..] => Image("TIFF"),
        [b'R', b'I', b'F', b'F', _, _, _, _, b'W', b'E', b'B', b'P', ..] => Image("WebP"),
        [b'G', b'I', b'F', b'8', ..] => Image("GIF"),
        [b'B', b'M', _, _, _, _, 0, 0, 0, 0, ..] => Image("BMP"),
        [0x28, 0xB5, 0x2F, 0xFD, ..] => Compressed("zstd", "zstd -dc"),
        [0xFD, b'7', b'z', b'X', b'Z', 0, ..] => Compressed("xz", "xz -dc"),
        [b'B', b'Z', b'h', b'1'..=b'9', 0x31, 0x41, ..] => Compressed("bzip2", "bzip2 -dc"),
        [0x04, 0x22, 0x4D, 0x18, ..] => Compressed("lz4", "lz4 -dc"),
        [0x1F, 0x9D, ..] => Compressed("compress", "uncompress -c"),
        [b'P', b'K', 3, 4, ..] => Compressed("zip", "unzip -p"),
        [b'7', b'z', 0xBC, 0xAF, ..] => Compressed("7-Zip", "7z x -so"),
        [0x1F, 0x8B, ..] => Compressed("gzip, twice or damaged", "gzip -dc"),
        [b'#', b'R', b'O', b'S', b'B', b'A', b'G', ..] => Recording("a ROS 1 bag"),
        [b'S', b'Q', b'L', b'i', b't', b'e', ..] => Recording("a SQLite database, perhaps a ROS 2 bag"),
        [0x89, b'M', b'C', b'A', b'P', ..] => Recording("an MCAP file, perhaps a ROS 2 bag"),
        _ => return None,
    };
    Some(kind)
}

/// What the first line says that is no comment.
fn of_text(text: &str) -> FileKind {
    // Some programs begin comments by a percent sign, as YAML does its directives.
    let is_comment =
        |line: &str| line.starts_with('#') || (line.starts_with('%') && !line.starts_with("%YAML"));
    let is_record = |line: &&str| !line.is_empty() && !is_comment(line);
    let mut records = text.split(['\n', '\r']).map(str::trim).filter(is_record);
    let Some(first) = records.next() else { return FileKind::Text };
    if hssh_io::is_table(first) {
        return FileKind::Table;
    }
    if first.starts_with("hssh-certificate") {
        return FileKind::Written("hssh-certificate".to_owned());
    }
    if first.starts_with('{') {
        return if hssh_io::is_json_lines(first) { FileKind::JsonLines } else { of_json(text) };
    }
    if first.starts_with(['(', '/']) || first.starts_with("Exploration") {
        return FileKind::Exploration;
    }
    if first.starts_with('<') {
        return FileKind::Foreign("a document of tags (XML, HTML, SVG)");
    }
    if first.starts_with("version https://git-lfs") {
        return FileKind::Foreign(
            "a pointer of Git LFS to a file that was not fetched (`git lfs pull` does)",
        );
    }
    if ["digraph ", "graph ", "strict "].iter().any(|word| first.starts_with(word)) && text.contains('{') {
        return FileKind::Foreign("a graph for Graphviz");
    }
    let word = first.split_whitespace().next().unwrap_or_default();
    let capitals = word.to_ascii_uppercase();
    if is_graph_record(&capitals) {
        return FileKind::PoseGraph(word.to_owned());
    }
    if is_message(&capitals) || (capitals == word && is_name(word)) {
        return FileKind::LaserLog(word.to_owned());
    }
    let is_key = |line: &str| {
        line.split_once(':').is_some_and(|(key, _)| ["image", "resolution", "origin"].contains(&key.trim()))
    };
    if is_key(first) || first == "---" || first.starts_with("%YAML") || records.take(8).any(is_key) {
        return FileKind::MapDescription;
    }
    FileKind::Text
}

/// What hssh prints says its format.
fn of_json(text: &str) -> FileKind {
    let format = text.split_once("\"format\"").and_then(|(_, rest)| rest.split('"').nth(1));
    match format {
        Some(format) if format.starts_with("hssh-") => FileKind::Written(format.chars().take(40).collect()),
        _ => FileKind::Foreign("JSON"),
    }
}

/// The records of pose graphs, in capitals.
fn is_graph_record(word: &str) -> bool {
    let begins = ["VERTEX", "EDGE", "PARAMS_", "FACTOR"];
    let whole = ["FIX", "ODOMETRY", "LANDMARK", "EQUIV", "BR", "POSE2D_NODE", "CONSTRAINT2"];
    begins.iter().any(|begin| word.starts_with(begin)) || whole.contains(&word)
}

/// The messages of CARMEN logs, in capitals.
fn is_message(word: &str) -> bool {
    const MESSAGES: [&str; 16] = [
        "FLASER",
        "RLASER",
        "ROBOTLASER",
        "RAWLASER",
        "LASER",
        "OLDLASER",
        "ODOM",
        "PARAM",
        "SYNC",
        "TRUEPOS",
        "NMEA",
        "GPS",
        "IMU",
        "SONAR",
        "BUMPER",
        "MARKER",
    ];
    MESSAGES.iter().any(|message| {
        word.strip_prefix(message)
            .is_some_and(|rest| rest.chars().all(|c| c.is_ascii_digit() || "GRSMCA".contains(c)))
    })
}

/// A word as messages are named that nobody can list.
fn is_name(word: &str) -> bool {
    word.len() > 2
        && word.starts_with(|c: char| c.is_ascii_uppercase())
        && word.chars().all(|c| c.is_ascii_uppercase() || c.is_ascii_digit() || c == '_')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn content_decides() {
        let of = |text: &str| FileKind::of(text.as_bytes());
        for log in ["FLASER 3 1 1 1", "flaser 3 1 1 1", "# x\n\r\nPARAM a b", "SOMETHING_ELSE 3"] {
            assert!(matches!(of(log), FileKind::LaserLog(_)), "{log}");
        }
        for graph in ["EDGE_SE2 1 2", "edge2 1 2", "\n\nVERTEX_SE3:QUAT 1", "ODOMETRY 0 1", "FIX 0"] {
            assert!(matches!(of(graph), FileKind::PoseGraph(_)), "{graph}");
        }
        for exploration in ["(stars: {})", "// a note\n(", "/* note */ (", "Exploration(\n"] {
            assert_eq!(of(exploration), FileKind::Exploration, "{exploration}");
        }
        assert_eq!(of("image: a.pgm\nresolution: 1"), FileKind::MapDescription);
        assert_eq!(of("resolution: 1\r\nimage: a.pgm"), FileKind::MapDescription);
        assert_eq!(of("P5\n3 3 255\n"), FileKind::Image("PGM"));
        assert_eq!(of("{\n  \"format\": \"hssh-answer\","), FileKind::Written("hssh-answer".into()));
        assert_eq!(of("# angle_min: -1\ntime,x,y,theta\n"), FileKind::Table);
        assert_eq!(of("\n{\"time\": 0, \"pose\": [0, 0, 0]}\n"), FileKind::JsonLines);
        assert!(matches!(FileKind::of(b"\x89MCAP0\r\n"), FileKind::Recording(_)));
        assert_eq!(of("hello"), FileKind::Text);
        assert_eq!(of(""), FileKind::Empty);
        assert_eq!(FileKind::of(&[0; 9]), FileKind::Foreign("binary data"));
        let told = of("{\"format\": \"hssh-a\n\u{1b}[31m\"").to_string();
        assert_eq!(told, "what hssh wrote (hssh-a\\n\\u{1b}[31m)");
        let told = of(&format!("EDGE\u{7}{}", "x".repeat(1_000_000))).to_string();
        assert!(told.len() < 100 && !told.contains('\u{7}'), "{told}");
        assert!(matches!(FileKind::of(b"\xFD7zXZ\0\0"), FileKind::Compressed("xz", _)));
    }
}
