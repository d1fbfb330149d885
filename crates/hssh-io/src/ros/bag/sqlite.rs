//! ROS 2 bags as SQLite databases (`.db3`), of any version of the schema.

use std::path::Path;

use rusqlite::types::ValueRef;
use rusqlite::{Connection, OpenFlags};

use super::{BagContents, BagError, BagMessage, Visit};
use crate::ros::wire::Wire;

/// How zstd begins: messages may be compressed one by one.
const ZSTD: &[u8] = &[0x28, 0xB5, 0x2F, 0xFD];
/// No message is larger when it is unpacked, in bytes.
const LARGEST: usize = 1 << 30;

pub(super) fn read(file: &Path, contents: &mut BagContents, visit: Visit<'_>) -> Result<(), BagError> {
    let damaged = |error: rusqlite::Error| BagError::damaged(file, error);
    let flags = OpenFlags::SQLITE_OPEN_READ_ONLY | OpenFlags::SQLITE_OPEN_NO_MUTEX;
    let database = Connection::open_with_flags(file, flags).map_err(damaged)?;
    let no_bag = |error: rusqlite::Error| match error {
        rusqlite::Error::SqliteFailure(code, _) if code.code == rusqlite::ErrorCode::DatabaseCorrupt => {
            BagError::damaged(file, "the database is cut off or overwritten in its first pages")
        }
        error => BagError::NoBag {
            file: file.to_owned(),
            reason: format!("the database has no table of topics as ROS 2 writes it ({error})"),
        },
    };
    let mut statement = database
        .prepare("SELECT id, name, type, serialization_format FROM topics ORDER BY id")
        .map_err(no_bag)?;
    let rows = statement.query_map([], |row| {
        Ok((
            row.get::<_, i64>(0)?,
            row.get::<_, String>(1)?,
            row.get::<_, String>(2)?,
            row.get::<_, String>(3)?,
        ))
    });
    let mut topics: Vec<(i64, usize)> = Vec::new();
    for row in rows.map_err(no_bag)? {
        let (id, name, type_name, format) = row.map_err(no_bag)?;
        let wire = (format == "cdr").then_some(Wire::Cdr);
        topics.push((id, contents.topic(&name, &type_name, wire)));
    }
    if let Err(error) = messages(&database, &topics, contents, visit) {
        contents.breaks.push(format!("{}: {error}", file.display()));
    }
    Ok(())
}

/// Goes through the table once: what is in the pages of messages that are not wanted is not read.
fn messages(
    database: &Connection,
    topics: &[(i64, usize)],
    contents: &mut BagContents,
    visit: Visit<'_>,
) -> rusqlite::Result<()> {
    // SQLite computes the last column only where it is asked for.
    let wanted: Vec<String> = topics
        .iter()
        .filter(|(_, topic)| contents.topics[*topic].is_read())
        .map(|(id, _)| id.to_string())
        .collect();
    let query = format!(
        "SELECT topic_id, timestamp, CASE WHEN topic_id IN ({}) THEN data END FROM messages ORDER BY id",
        wanted.join(",")
    );
    let mut statement = database.prepare(&query)?;
    let mut rows = statement.query([])?;
    while let Some(row) = rows.next()? {
        let (id, time): (i64, i64) = (row.get(0)?, row.get(1)?);
        let Some(&(_, topic)) = topics.iter().find(|topic| topic.0 == id) else { continue };
        contents.topics[topic].messages += 1;
        contents.extend_span(time);
        if let ValueRef::Blob(bytes) = row.get_ref(2)? {
            let unpacked = bytes.starts_with(ZSTD).then(|| unpacked(bytes)).flatten();
            let bytes = unpacked.as_deref().unwrap_or(bytes);
            visit(BagMessage { topic: &contents.topics[topic], time, bytes });
        }
    }
    Ok(())
}

fn unpacked(bytes: &[u8]) -> Option<Vec<u8>> {
    use std::io::Read;
    let mut unpacked = Vec::new();
    let decoder = zstd::stream::read::Decoder::with_buffer(bytes).ok()?;
    decoder.take(LARGEST as u64).read_to_end(&mut unpacked).ok()?;
    Some(unpacked)
}
