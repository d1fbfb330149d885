//! ROS 1 bags: by their index, or chunk by chunk where there is none.

use std::collections::HashMap;
use std::fs::File;
use std::io::{self, BufReader, Read, Seek, SeekFrom};
use std::path::Path;

use super::ros1_record::{Fields, exactly, header, op, u32};
use super::{BagContents, BagError, BagMessage, Visit};
use crate::ros::wire::Wire;

/// The line that all bags of the format begin with.
const VERSION: &[u8] = b"#ROSBAG V2.0\n";

/// A bag that is being read.
struct Bag<'a> {
    file: &'a Path,
    contents: &'a mut BagContents,
    /// The topic of each connection.
    connections: HashMap<u32, usize>,
    /// Whether messages are counted by the index.
    is_counted: bool,
    /// Whether any message was met.
    any: bool,
    /// Whether a chunk is being read: chunks are not within chunks.
    in_chunk: bool,
}

/// Why reading ends early.
enum Stop {
    Break(io::Error),
    Error(BagError),
}

impl From<io::Error> for Stop {
    fn from(error: io::Error) -> Self {
        Stop::Break(error)
    }
}

pub(super) fn read(file: &Path, contents: &mut BagContents, visit: Visit<'_>) -> Result<(), BagError> {
    let mut source = BufReader::with_capacity(1 << 16, File::open(file).map_err(BagError::read(file))?);
    let version = exactly(&mut source, VERSION.len() as u32).unwrap_or_default();
    if version != VERSION {
        let reason = "it is a ROS 1 bag of another version than 2.0; `rosbag fix` brings old ones up to date"
            .to_owned();
        return Err(BagError::NoBag { file: file.to_owned(), reason });
    }
    let mut bag =
        Bag { file, contents, connections: HashMap::new(), is_counted: false, any: false, in_chunk: false };
    let chunks = index(&mut source);
    let read = match chunks {
        Some(index) => bag.read_indexed(&mut source, index, visit),
        None => source
            .seek(SeekFrom::Start(VERSION.len() as u64))
            .map_err(Stop::Break)
            .and_then(|_| bag.read_records(&mut source, visit)),
    };
    match read {
        Ok(()) => Ok(()),
        Err(Stop::Error(error)) => Err(error),
        Err(Stop::Break(error)) => {
            let reason = match error.kind() {
                io::ErrorKind::UnexpectedEof => "it ends in the middle of a record".to_owned(),
                _ => error.to_string(),
            };
            if !bag.any {
                return Err(BagError::damaged(file, reason));
            }
            bag.contents.breaks.push(format!("{}: {reason}", file.display()));
            Ok(())
        }
    }
}

/// What the end of a bag says: its connections, and where which chunk is.
struct Index {
    connections: Vec<(Fields, Fields)>,
    chunks: Vec<ChunkInfo>,
}

struct ChunkInfo {
    at: u64,
    span: [i64; 2],
    /// Connections with the number of their messages.
    counts: Vec<(u32, u32)>,
}

/// The index of a bag that was closed.
fn index(source: &mut BufReader<File>) -> Option<Index> {
    let (bag, _) = header(source).ok()??;
    let at = bag.u64("index_pos").filter(|&at| at > 0 && bag.op() == op::BAG)?;
    let (connections, chunks) = (bag.u32("conn_count")? as usize, bag.u32("chunk_count")? as usize);
    source.seek(SeekFrom::Start(at)).ok()?;
    let mut index = Index { connections: Vec::new(), chunks: Vec::new() };
    while let Some((fields, length)) = header(source).ok()? {
        let data = exactly(source, length).ok()?;
        match fields.op() {
            op::CONNECTION => index.connections.push((fields, Fields::parse(&data).ok()?)),
            op::CHUNK_INFO => {
                let pairs = data.chunks_exact(8).filter_map(|pair| Some((u32(pair)?, u32(&pair[4..])?)));
                index.chunks.push(ChunkInfo {
                    at: fields.u64("chunk_pos")?,
                    span: [fields.time("start_time")?, fields.time("end_time")?],
                    counts: pairs.collect(),
                });
            }
            _ => {}
        }
    }
    let is_whole = index.connections.len() >= connections && index.chunks.len() == chunks && chunks > 0;
    is_whole.then_some(index)
}

impl Bag<'_> {
    fn connect(&mut self, outer: &Fields, inner: &Fields) {
        let Some(id) = outer.u32("conn") else { return };
        let topic = self.contents.topic(&outer.text("topic"), &inner.text("type"), Some(Wire::Ros1));
        self.connections.insert(id, topic);
    }

    fn read_indexed(
        &mut self,
        source: &mut BufReader<File>,
        index: Index,
        visit: Visit<'_>,
    ) -> Result<(), Stop> {
        for (outer, inner) in &index.connections {
            self.connect(outer, inner);
        }
        self.is_counted = true;
        for chunk in &index.chunks {
            for (connection, count) in &chunk.counts {
                if let Some(&topic) = self.connections.get(connection) {
                    self.contents.topics[topic].messages += u64::from(*count);
                }
            }
            chunk.span.into_iter().for_each(|time| self.contents.extend_span(time));
        }
        let is_read =
            |id: &u32| self.connections.get(id).is_some_and(|&topic| self.contents.topics[topic].is_read());
        let wanted: Vec<u64> = index
            .chunks
            .iter()
            .filter(|chunk| chunk.counts.iter().any(|(connection, _)| is_read(connection)))
            .map(|chunk| chunk.at)
            .collect();
        for at in wanted {
            source.seek(SeekFrom::Start(at))?;
            let Some((fields, length)) = header(source)? else {
                return Err(io::Error::from(io::ErrorKind::UnexpectedEof).into());
            };
            self.read_chunk(&fields, source, length, visit)?;
        }
        Ok(())
    }

    /// Reads record by record: connections, messages, and chunks of them.
    fn read_records(&mut self, source: &mut impl Read, visit: Visit<'_>) -> Result<(), Stop> {
        while let Some((fields, length)) = header(source)? {
            match fields.op() {
                op::CHUNK if !self.in_chunk => self.read_chunk(&fields, source, length, visit)?,
                op::CONNECTION => {
                    let inner = Fields::parse(&exactly(source, length)?)?;
                    self.connect(&fields, &inner);
                }
                op::MESSAGE => {
                    let topic = fields.u32("conn").and_then(|id| self.connections.get(&id)).copied();
                    let time = fields.time("time").unwrap_or_default();
                    self.any = true;
                    if let Some(topic) = topic {
                        if !self.is_counted {
                            self.contents.topics[topic].messages += 1;
                            self.contents.extend_span(time);
                        }
                        if self.contents.topics[topic].is_read() {
                            let bytes = exactly(source, length)?;
                            visit(BagMessage { topic: &self.contents.topics[topic], time, bytes: &bytes });
                            continue;
                        }
                    }
                    skip(source, length)?;
                }
                _ => skip(source, length)?,
            }
        }
        Ok(())
    }

    fn read_chunk(
        &mut self,
        fields: &Fields,
        source: &mut impl Read,
        length: u32,
        visit: Visit<'_>,
    ) -> Result<(), Stop> {
        let mut packed = source.take(u64::from(length));
        let compression = fields.text("compression");
        self.read_unpacked(&compression, &mut packed, visit)?;
        let left = packed.limit();
        if left > 0 {
            skip(&mut packed, left as u32)?;
        }
        Ok(())
    }

    fn read_unpacked(
        &mut self,
        compression: &str,
        packed: &mut dyn Read,
        visit: Visit<'_>,
    ) -> Result<(), Stop> {
        let unpacked: Box<dyn Read + '_> = match compression {
            "none" => Box::new(packed),
            "bz2" => Box::new(bzip2::read::MultiBzDecoder::new(packed)),
            "lz4" => Box::new(lz4::Decoder::new(packed)?),
            other => {
                let (file, by) = (self.file.to_owned(), other.chars().take(40).collect());
                return Err(Stop::Error(BagError::Compression { file, by, known: "none, bz2 and lz4" }));
            }
        };
        self.in_chunk = true;
        let read = self.read_records(&mut BufReader::with_capacity(1 << 16, unpacked), visit);
        self.in_chunk = false;
        read
    }
}

fn skip(source: &mut impl Read, length: u32) -> io::Result<()> {
    let skipped = io::copy(&mut source.take(u64::from(length)), &mut io::sink())?;
    if skipped < u64::from(length) { Err(io::ErrorKind::UnexpectedEof.into()) } else { Ok(()) }
}
