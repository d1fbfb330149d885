//! The records of ROS 1 bags, version 2.0 (wiki.ros.org/Bags/Format/2.0): a header of named fields, and data.

use std::io::{self, Read};

/// No header or chunk is larger, in bytes: what says so is damaged.
const LARGEST: u32 = 1 << 30;

/// What a record is, by its field `op`.
pub(super) mod op {
    pub(in crate::ros::bag) const MESSAGE: u8 = 2;
    pub(in crate::ros::bag) const BAG: u8 = 3;
    pub(in crate::ros::bag) const CHUNK: u8 = 5;
    pub(in crate::ros::bag) const CHUNK_INFO: u8 = 6;
    pub(in crate::ros::bag) const CONNECTION: u8 = 7;
}

/// Named fields of any bytes.
#[derive(Debug, Default)]
pub(super) struct Fields(Vec<(String, Vec<u8>)>);

impl Fields {
    pub(super) fn parse(mut bytes: &[u8]) -> io::Result<Self> {
        let mut fields = Vec::new();
        while !bytes.is_empty() {
            let length = u32(bytes).map(|length| length as usize).ok_or_else(damaged)?;
            let field = bytes.get(4..4 + length).ok_or_else(damaged)?;
            let equals = field.iter().position(|&byte| byte == b'=').ok_or_else(damaged)?;
            fields
                .push((String::from_utf8_lossy(&field[..equals]).into_owned(), field[equals + 1..].to_vec()));
            bytes = &bytes[4 + length..];
        }
        Ok(Fields(fields))
    }

    pub(super) fn get(&self, name: &str) -> Option<&[u8]> {
        self.0.iter().find(|field| field.0 == name).map(|field| &field.1[..])
    }

    pub(super) fn text(&self, name: &str) -> String {
        self.get(name).map_or_else(String::new, |bytes| String::from_utf8_lossy(bytes).into_owned())
    }

    pub(super) fn u32(&self, name: &str) -> Option<u32> {
        self.get(name).and_then(u32)
    }

    pub(super) fn u64(&self, name: &str) -> Option<u64> {
        self.get(name).and_then(|bytes| Some(u64::from_le_bytes(*bytes.first_chunk()?)))
    }

    /// Seconds and nanoseconds, as nanoseconds.
    pub(super) fn time(&self, name: &str) -> Option<i64> {
        let bytes = self.get(name)?;
        Some(i64::from(u32(bytes)?) * 1_000_000_000 + i64::from(u32(bytes.get(4..)?)?))
    }

    pub(super) fn op(&self) -> u8 {
        self.get("op").and_then(|bytes| bytes.first().copied()).unwrap_or_default()
    }
}

/// The number that bytes begin with.
pub(super) fn u32(bytes: &[u8]) -> Option<u32> {
    Some(u32::from_le_bytes(*bytes.first_chunk()?))
}

fn damaged() -> io::Error {
    io::Error::new(io::ErrorKind::InvalidData, "a record is damaged")
}

/// The header of the next record and the length of its data, or `None` where the source ends between records.
pub(super) fn header(source: &mut impl Read) -> io::Result<Option<(Fields, u32)>> {
    let mut length = [0; 4];
    match source.read(&mut length)? {
        0 => return Ok(None),
        read => source.read_exact(&mut length[read..])?,
    }
    let fields = Fields::parse(&exactly(source, u32::from_le_bytes(length))?)?;
    let mut length = [0; 4];
    source.read_exact(&mut length)?;
    Ok(Some((fields, u32::from_le_bytes(length))))
}

/// So many bytes; of a damaged length no more is kept than there are.
pub(super) fn exactly(source: &mut impl Read, length: u32) -> io::Result<Vec<u8>> {
    if length > LARGEST {
        return Err(damaged());
    }
    let mut bytes = Vec::new();
    source.take(u64::from(length)).read_to_end(&mut bytes)?;
    if bytes.len() < length as usize { Err(io::ErrorKind::UnexpectedEof.into()) } else { Ok(bytes) }
}
