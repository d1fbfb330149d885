//! MCAP files: chunks without wanted topics are skipped by the index; without an index, everything is gone through.

use std::collections::HashMap;
use std::fs::File;
use std::io::{BufReader, Read, Seek, SeekFrom};
use std::path::Path;

use mcap::records::{MessageHeader, Record};
use mcap::sans_io::indexed_reader::ReadOrder;
use mcap::sans_io::{
    IndexedReadEvent, IndexedReader, IndexedReaderOptions, LinearReadEvent, LinearReader,
    LinearReaderOptions, SummaryReadEvent, SummaryReader, SummaryReaderOptions,
};
use mcap::{McapError, Summary, parse_record};

use super::{BagContents, BagError, BagMessage, Visit};
use crate::ros::wire::Wire;

/// No record is larger, in bytes: what says so is damaged.
const LARGEST: usize = 1 << 30;

pub(super) fn read(file: &Path, contents: &mut BagContents, visit: Visit<'_>) -> Result<(), BagError> {
    let mut source = File::open(file).map_err(BagError::read(file))?;
    let size = source.metadata().map_err(BagError::read(file))?.len();
    match summary(&mut source, size) {
        Some(summary) if is_index(&summary) => indexed(file, source, &summary, contents, visit),
        _ => linear(file, BufReader::with_capacity(1 << 18, source), contents, visit),
    }
}

/// The summary at the end, if the file got so far.
fn summary(source: &mut File, size: u64) -> Option<Summary> {
    let options = SummaryReaderOptions::default().with_file_size(size).with_record_length_limit(LARGEST);
    let mut reader = SummaryReader::new_with_options(options);
    while let Some(event) = reader.next_event() {
        match event.ok()? {
            SummaryReadEvent::ReadRequest(length) => {
                let read = source.read(reader.insert(length.min(LARGEST))).ok()?;
                reader.notify_read(read);
            }
            SummaryReadEvent::SeekRequest(to) => reader.notify_seeked(source.seek(to).ok()?),
        }
    }
    reader.finish()
}

/// Whether a summary says of all messages where they are.
fn is_index(summary: &Summary) -> bool {
    let are_counted = summary.stats.as_ref().is_some_and(|stats| {
        stats.chunk_count as usize == summary.chunk_indexes.len() && stats.message_count > 0
    });
    are_counted && !summary.chunk_indexes.is_empty() && !summary.channels.is_empty()
}

fn indexed(
    file: &Path,
    mut source: File,
    summary: &Summary,
    contents: &mut BagContents,
    visit: Visit<'_>,
) -> Result<(), BagError> {
    let mut topics: HashMap<u16, usize> = HashMap::new();
    let mut channels: Vec<_> = summary.channels.values().collect();
    channels.sort_by_key(|channel| channel.id);
    for channel in channels {
        let type_name = channel.schema.as_ref().map_or("", |schema| schema.name.as_str());
        topics.insert(channel.id, contents.topic(&channel.topic, type_name, wire(&channel.message_encoding)));
    }
    if let Some(stats) = &summary.stats {
        for (id, count) in &stats.channel_message_counts {
            if let Some(&topic) = topics.get(id) {
                contents.topics[topic].messages += count;
            }
        }
        contents.extend_span(stats.message_start_time as i64);
        contents.extend_span(stats.message_end_time as i64);
    }
    let wanted = contents.topics.iter().filter(|topic| topic.is_read()).map(|topic| topic.name.clone());
    let options = IndexedReaderOptions::new()
        .with_order(ReadOrder::File)
        .include_topics(wanted)
        .with_record_length_limit(LARGEST);
    let damaged = |error: McapError| failure(file, error);
    let mut reader = IndexedReader::new_with_options(summary, options).map_err(damaged)?;
    let mut buffer = Vec::new();
    let mut any = false;
    loop {
        let (offset, length) = match reader.next_event() {
            None => return Ok(()),
            Some(Ok(IndexedReadEvent::ReadChunkRequest { offset, length })) => (offset, length),
            Some(Ok(IndexedReadEvent::Message { header, data })) => {
                if let Some(&topic) = topics.get(&header.channel_id) {
                    any = true;
                    tell(contents, topic, &header, data, visit);
                }
                continue;
            }
            Some(Err(error)) => return break_off(file, error, any, contents),
        };
        let read = source.seek(SeekFrom::Start(offset)).and_then(|_| {
            buffer.clear();
            source.by_ref().take(length as u64).read_to_end(&mut buffer)
        });
        read.map_err(BagError::read(file))?;
        if let Err(error) = reader.insert_chunk_record_data(offset, &buffer) {
            return break_off(file, error, any, contents);
        }
    }
}

/// Reads record by record, up to a break if there is one; as it comes, if somebody is still writing.
pub(super) fn linear(
    file: &Path,
    mut source: impl Read,
    contents: &mut BagContents,
    visit: Visit<'_>,
) -> Result<(), BagError> {
    let options = LinearReaderOptions::default().with_record_length_limit(LARGEST);
    let mut reader = LinearReader::new_with_options(options);
    let mut schemas: HashMap<u16, String> = HashMap::new();
    let mut topics: HashMap<u16, usize> = HashMap::new();
    let mut any = false;
    loop {
        let (opcode, data) = match reader.next_event() {
            None => return Ok(()),
            Some(Ok(LinearReadEvent::ReadRequest(length))) => {
                let read =
                    source.read(reader.insert(length.clamp(1, 1 << 20))).map_err(BagError::read(file))?;
                reader.notify_read(read);
                continue;
            }
            Some(Ok(LinearReadEvent::Record { data, opcode })) => (opcode, data),
            Some(Err(error)) => return break_off(file, error, any, contents),
        };
        match parse_record(opcode, data) {
            Ok(Record::Schema { header, .. }) => drop(schemas.insert(header.id, header.name)),
            Ok(Record::Channel(channel)) => {
                let type_name = schemas.get(&channel.schema_id).map_or("", String::as_str);
                topics.insert(
                    channel.id,
                    contents.topic(&channel.topic, type_name, wire(&channel.message_encoding)),
                );
            }
            Ok(Record::Message { header, data }) => {
                any = true;
                if let Some(&topic) = topics.get(&header.channel_id) {
                    contents.topics[topic].messages += 1;
                    contents.extend_span(header.log_time as i64);
                    if contents.topics[topic].is_read() {
                        tell(contents, topic, &header, &data, visit);
                    }
                }
            }
            Ok(_) => {}
            Err(error) => return break_off(file, error, any, contents),
        }
    }
}

fn tell(contents: &BagContents, topic: usize, header: &MessageHeader, bytes: &[u8], visit: Visit<'_>) {
    visit(BagMessage { topic: &contents.topics[topic], time: header.log_time as i64, bytes });
}

/// How messages of an encoding are written.
fn wire(encoding: &str) -> Option<Wire> {
    match encoding {
        "cdr" => Some(Wire::Cdr),
        "ros1" => Some(Wire::Ros1),
        _ => None,
    }
}

/// What was read before an error is of use, if anything was.
fn break_off(file: &Path, error: McapError, any: bool, contents: &mut BagContents) -> Result<(), BagError> {
    match error {
        McapError::UnsupportedCompression(_) => Err(failure(file, error)),
        error if any => {
            contents.breaks.push(format!("{}: {}", file.display(), reason(&error)));
            Ok(())
        }
        error => Err(failure(file, error)),
    }
}

fn failure(file: &Path, error: McapError) -> BagError {
    match error {
        McapError::UnsupportedCompression(by) => {
            BagError::Compression { file: file.to_owned(), by, known: "zstd and lz4" }
        }
        error => BagError::damaged(file, reason(&error)),
    }
}

fn reason(error: &McapError) -> String {
    match error {
        McapError::UnexpectedEof | McapError::UnexpectedEoc => "it ends in the middle of a record".to_owned(),
        other => other.to_string(),
    }
}
