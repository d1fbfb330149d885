//! The two ways in which ROS writes a message as bytes: CDR (aligned, either order of bytes) and that of ROS 1 (packed).
//!
//! CDR: OMG DDS-XTYPES 1.3, section 7.4.1 (XCDR version 1, final types). ROS 1: wiki.ros.org/msg, "Fields".

/// How a message is written.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Wire {
    /// As ROS 2 does.
    Cdr,
    /// As ROS 1 does.
    Ros1,
}

/// Why a message cannot be read.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
pub(crate) enum WireError {
    #[error("it ends after {0} bytes, in the middle of a field")]
    Short(usize),
    #[error("it is written in a way that ROS 2 does not use (encapsulation {0:#06x})")]
    Encapsulation(u16),
}

/// Reads a message field by field.
#[derive(Clone, Debug)]
pub(crate) struct Fields<'a> {
    bytes: &'a [u8],
    at: usize,
    wire: Wire,
    is_big_endian: bool,
}

impl<'a> Fields<'a> {
    pub(crate) fn new(bytes: &'a [u8], wire: Wire) -> Result<Self, WireError> {
        let mut fields = Fields { bytes, at: 0, wire, is_big_endian: false };
        if wire == Wire::Cdr {
            let header = bytes.first_chunk::<4>().ok_or(WireError::Short(bytes.len()))?;
            match u16::from_be_bytes([header[0], header[1]]) {
                0 => fields.is_big_endian = true,
                1 => {}
                other => return Err(WireError::Encapsulation(other)),
            }
            fields.bytes = &bytes[4..];
        }
        Ok(fields)
    }

    pub(crate) fn wire(&self) -> Wire {
        self.wire
    }

    fn take(&mut self, length: usize) -> Result<&'a [u8], WireError> {
        let taken = self.at.checked_add(length).and_then(|end| self.bytes.get(self.at..end));
        let taken = taken.ok_or(WireError::Short(self.bytes.len()))?;
        self.at += length;
        Ok(taken)
    }

    /// A number of so many bytes, the least one first.
    fn number<const N: usize>(&mut self) -> Result<[u8; N], WireError> {
        if self.wire == Wire::Cdr {
            self.at = self.at.next_multiple_of(N);
        }
        let mut bytes: [u8; N] = self.take(N)?.try_into().map_err(|_| WireError::Short(self.at))?;
        if self.is_big_endian {
            bytes.reverse();
        }
        Ok(bytes)
    }

    pub(crate) fn u32(&mut self) -> Result<u32, WireError> {
        self.number().map(u32::from_le_bytes)
    }

    pub(crate) fn i32(&mut self) -> Result<i32, WireError> {
        self.number().map(i32::from_le_bytes)
    }

    pub(crate) fn f32(&mut self) -> Result<f32, WireError> {
        self.number().map(f32::from_le_bytes)
    }

    pub(crate) fn f64(&mut self) -> Result<f64, WireError> {
        self.number().map(f64::from_le_bytes)
    }

    /// Text, without the zero that ends it in CDR.
    pub(crate) fn text(&mut self) -> Result<String, WireError> {
        let length = self.u32()? as usize;
        let bytes = self.take(length)?;
        let bytes = if self.wire == Wire::Cdr { bytes.strip_suffix(&[0]).unwrap_or(bytes) } else { bytes };
        Ok(String::from_utf8_lossy(bytes).into_owned())
    }

    pub(crate) fn floats(&mut self) -> Result<Vec<f32>, WireError> {
        let length = self.u32()? as usize;
        if length > (self.bytes.len() - self.at) / 4 {
            return Err(WireError::Short(self.bytes.len()));
        }
        (0..length).map(|_| self.f32()).collect()
    }

    /// How many elements of a sequence follow, each of which takes a byte at least.
    pub(crate) fn length(&mut self) -> Result<usize, WireError> {
        let length = self.u32()? as usize;
        if length > self.bytes.len() { Err(WireError::Short(self.bytes.len())) } else { Ok(length) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cdr_is_aligned_and_ros_1_is_packed() {
        let cdr = [0, 1, 0, 0, 2, 0, 0, 0, b'a', 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0xf0, 0x3f];
        let mut fields = Fields::new(&cdr, Wire::Cdr).unwrap();
        assert_eq!((fields.text().unwrap(), fields.f64()), ("a".into(), Ok(0.0)));
        let mut fields = Fields::new(&cdr[4..], Wire::Ros1).unwrap();
        assert_eq!(fields.text().unwrap(), "a\0");
        let big = [0, 0, 0, 0, 0, 0, 0, 7];
        assert_eq!(Fields::new(&big, Wire::Cdr).unwrap().u32(), Ok(7));
        assert_eq!(Fields::new(&[0, 9, 0, 0], Wire::Cdr).unwrap_err(), WireError::Encapsulation(9));
    }

    #[test]
    fn lengths_that_cannot_be_are_refused() {
        let endless = [0, 1, 0, 0, 0xff, 0xff, 0xff, 0xff, 1, 2, 3];
        assert!(Fields::new(&endless, Wire::Cdr).unwrap().text().is_err());
        assert!(Fields::new(&endless, Wire::Cdr).unwrap().floats().is_err());
        assert!(Fields::new(&endless, Wire::Cdr).unwrap().length().is_err());
    }
}
