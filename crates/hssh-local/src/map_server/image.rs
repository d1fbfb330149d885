//! The images of maps as gray values: PGM (P2, P5) and PNG, decoded and encoded, and others, decoded.

use std::io::Cursor;

use image::{ImageFormat, ImageReader};
use png::{BitDepth, ColorType, Compression, Decoder, Encoder, Filter, Reader, Transformations};

/// An image of which the size is known and the pixels are still to be decoded.
pub(super) enum Encoded<'a> {
    Pgm(Pgm<'a>),
    Png(Box<Reader<Cursor<&'a [u8]>>>),
    Other(Other<'a>),
}

/// An image that another library decodes.
pub(super) struct Other<'a> {
    bytes: &'a [u8],
    format: ImageFormat,
    size: (u32, u32),
}

/// A pixel: its gray value and its opacity.
pub(super) type Pixel = [u8; 2];

/// A portable graymap after its header.
pub(super) struct Pgm<'a> {
    is_plain: bool,
    width: u32,
    height: u32,
    white: u32,
    raster: &'a [u8],
}

impl<'a> Encoded<'a> {
    /// Reads as much as says what the image is; an error says what is wrong with it.
    pub(super) fn open(bytes: &'a [u8]) -> Result<Self, String> {
        match bytes {
            [b'P', b'2', rest @ ..] => Pgm::open(true, rest).map(Encoded::Pgm),
            [b'P', b'5', rest @ ..] => Pgm::open(false, rest).map(Encoded::Pgm),
            [0x89, b'P', b'N', b'G', ..] => {
                let mut decoder = Decoder::new(Cursor::new(bytes));
                decoder.set_transformations(Transformations::normalize_to_color8());
                let reader = decoder.read_info().map_err(|error| error.to_string())?;
                Ok(Encoded::Png(Box::new(reader)))
            }
            [] => Err("the file is empty".to_owned()),
            _ => Other::open(bytes).map(Encoded::Other),
        }
    }

    /// Width and height in pixels.
    pub(super) fn size(&self) -> (u32, u32) {
        match self {
            Encoded::Pgm(pgm) => (pgm.width, pgm.height),
            Encoded::Png(reader) => reader.info().size(),
            Encoded::Other(other) => other.size,
        }
    }

    /// All pixels, the top row first.
    pub(super) fn pixels(self) -> Result<Vec<Pixel>, String> {
        match self {
            Encoded::Pgm(pgm) => pgm.pixels(),
            Encoded::Png(reader) => png_pixels(*reader),
            Encoded::Other(other) => other.pixels(),
        }
    }
}

impl<'a> Other<'a> {
    fn open(bytes: &'a [u8]) -> Result<Self, String> {
        const READ: [ImageFormat; 4] =
            [ImageFormat::Bmp, ImageFormat::Jpeg, ImageFormat::Tiff, ImageFormat::WebP];
        let format = image::guess_format(bytes).ok().filter(|format| READ.contains(format));
        let format = format.ok_or("it begins like none of them")?;
        let size = reader(bytes, format).into_dimensions().map_err(|error| error.to_string())?;
        Ok(Other { bytes, format, size })
    }

    fn pixels(self) -> Result<Vec<Pixel>, String> {
        let image = reader(self.bytes, self.format).decode().map_err(|error| error.to_string())?;
        let to_pixel = |[red, green, blue, alpha]: [u8; 4]| [luminance([red, green, blue]), alpha];
        Ok(image.to_rgba8().pixels().map(|pixel| to_pixel(pixel.0)).collect())
    }
}

fn reader(bytes: &[u8], format: ImageFormat) -> ImageReader<Cursor<&[u8]>> {
    ImageReader::with_format(Cursor::new(bytes), format)
}

impl<'a> Pgm<'a> {
    fn open(is_plain: bool, mut text: &'a [u8]) -> Result<Self, String> {
        let mut field = |name: &str| number(&mut text).ok_or_else(|| format!("its header has no {name}"));
        let (width, height, white) = (field("width")?, field("height")?, field("greatest gray value")?);
        if !(1..=0xFFFF).contains(&white) {
            return Err(format!("its greatest gray value is {white}, but must be between 1 and 65535"));
        }
        // One space ends the header; what comes next may look like space and be a pixel.
        Ok(Pgm { is_plain, width, height, white, raster: text.get(1..).unwrap_or_default() })
    }

    fn pixels(self) -> Result<Vec<Pixel>, String> {
        let Pgm { is_plain, width, height, white, mut raster } = self;
        let expected = u64::from(width) * u64::from(height);
        let is_wide = white > 0xFF;
        let room = raster.len() as u64 / if is_wide || is_plain { 2 } else { 1 };
        let mut pixels = Vec::with_capacity(expected.min(room + 1) as usize);
        while (pixels.len() as u64) < expected {
            let value = match *raster {
                _ if is_plain => number(&mut raster),
                [high, low, ref rest @ ..] if is_wide => {
                    raster = rest;
                    Some(u32::from(u16::from_be_bytes([high, low])))
                }
                [value, ref rest @ ..] if !is_wide => {
                    raster = rest;
                    Some(u32::from(value))
                }
                _ => None,
            };
            let value =
                value.ok_or_else(|| format!("it ends after {} of {expected} pixels", pixels.len()))?;
            if value > white {
                return Err(format!("a pixel is {value}, above the greatest gray value {white}"));
            }
            pixels.push([((value * 0xFF + white / 2) / white) as u8, 0xFF]);
        }
        Ok(pixels)
    }
}

/// The number that comes next, after spaces and comments; `None` if there is no number or too great a one.
fn number(text: &mut &[u8]) -> Option<u32> {
    loop {
        *text = text.trim_ascii_start();
        let Some(comment) = text.strip_prefix(b"#") else { break };
        let end = comment.iter().position(|&byte| byte == b'\n').unwrap_or(comment.len());
        *text = &comment[end..];
    }
    let end = text.iter().position(|byte| !byte.is_ascii_digit()).unwrap_or(text.len());
    let (digits, rest) = text.split_at(end);
    *text = rest;
    std::str::from_utf8(digits).ok()?.parse().ok()
}

fn png_pixels(mut reader: Reader<Cursor<&[u8]>>) -> Result<Vec<Pixel>, String> {
    let size = reader.output_buffer_size().ok_or("it is too large")?;
    let mut samples = vec![0; size];
    reader.next_frame(&mut samples).map_err(|error| error.to_string())?;
    Ok(match reader.output_color_type().0 {
        ColorType::Grayscale => samples.iter().map(|&gray| [gray, 0xFF]).collect(),
        ColorType::GrayscaleAlpha => samples.as_chunks().0.to_vec(),
        ColorType::Rgb => samples.as_chunks().0.iter().map(|&rgb| [luminance(rgb), 0xFF]).collect(),
        ColorType::Rgba => {
            samples.as_chunks().0.iter().map(|&[r, g, b, alpha]| [luminance([r, g, b]), alpha]).collect()
        }
        ColorType::Indexed => return Err("its palette cannot be read".to_owned()),
    })
}

/// The gray of a color, in the weights of ITU-R BT.709.
fn luminance(rgb: [u8; 3]) -> u8 {
    let [red, green, blue] = rgb.map(u32::from);
    ((2126 * red + 7152 * green + 722 * blue) / 10_000) as u8
}

/// Gray values, the top row first, as a binary PGM.
pub(super) fn encode_pgm(width: u32, height: u32, gray: &[u8]) -> Vec<u8> {
    [format!("P5\n{width} {height}\n255\n").as_bytes(), gray].concat()
}

/// Gray values, the top row first, as a PNG.
pub(super) fn encode_png(width: u32, height: u32, gray: &[u8]) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = Encoder::new(&mut bytes, width, height);
    encoder.set_color(ColorType::Grayscale);
    encoder.set_depth(BitDepth::Eight);
    encoder.set_compression(Compression::Fast);
    encoder.set_filter(Filter::Adaptive);
    let written = encoder.write_header().and_then(|mut writer| writer.write_image_data(gray));
    written.expect("an image with at least one pixel is written to memory");
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grays(bytes: &[u8]) -> Result<Vec<u8>, String> {
        Ok(Encoded::open(bytes)?.pixels()?.into_iter().map(|[gray, _]| gray).collect())
    }

    /// Whatever the format, the gray values are those that were encoded; JPEG is nearly so.
    #[test]
    fn images_of_every_kind_say_the_same() {
        let gray: Vec<u8> = (0..16 * 16).map(|index| if index / 16 < 8 { 205 } else { 0 }).collect();
        let image = image::GrayImage::from_raw(16, 16, gray.clone()).unwrap();
        let image = image::DynamicImage::from(image);
        for format in [ImageFormat::Bmp, ImageFormat::Jpeg, ImageFormat::Tiff, ImageFormat::WebP] {
            let mut bytes = Cursor::new(Vec::new());
            let image = image::DynamicImage::from(image.to_rgb8());
            image.write_to(&mut bytes, format).unwrap();
            let bytes = bytes.into_inner();
            assert_eq!(Encoded::open(&bytes).map(|image| image.size()), Ok((16, 16)));
            let most = if format == ImageFormat::Jpeg { 8 } else { 1 };
            let found = grays(&bytes).unwrap();
            assert!(found.iter().zip(&gray).all(|(one, other)| one.abs_diff(*other) <= most), "{format:?}");
            assert!(grays(&bytes[..bytes.len() / 2]).is_err(), "{format:?} cut off");
        }
        assert!(grays(b"GIF89a").is_err());
    }

    #[test]
    fn graymaps_of_every_kind_say_the_same() {
        let expected = Ok(vec![0, 51, 255]);
        assert_eq!(grays(b"P2 3 1 255 0 51 255"), expected);
        assert_eq!(grays(b"P2\n# three\n3 1 # wide\n5\n0 1\n# the last\n5\n"), expected);
        assert_eq!(grays(b"P5 3 1 255\n\x00\x33\xFF"), expected);
        assert_eq!(grays(b"P5\n3 1\n65535\n\x00\x00\x33\x33\xFF\xFF"), expected);
        // The first pixel has the code of a space.
        assert_eq!(grays(b"P5\n2 1\n255\n\x20\x0A"), Ok(vec![0x20, 0x0A]));
    }

    #[test]
    fn what_is_wrong_with_a_graymap_is_said() {
        assert_eq!(grays(b"P5\n2 2\n255\nabc").unwrap_err(), "it ends after 3 of 4 pixels");
        assert_eq!(grays(b"P2\n2 2\n255\n1 2 x").unwrap_err(), "it ends after 2 of 4 pixels");
        assert_eq!(grays(b"P2\n2\n").unwrap_err(), "its header has no height");
        assert_eq!(grays(b"P2 1 1 9 10").unwrap_err(), "a pixel is 10, above the greatest gray value 9");
        assert!(grays(b"P5 1 1 0 ").unwrap_err().contains("must be between 1 and 65535"));
        assert_eq!(grays(b"P6 1 1 255 abc").unwrap_err(), "it begins like none of them");
    }

    /// White is light and black dark in every kind of PNG, and what is transparent says so.
    #[test]
    fn pngs_of_every_kind_say_the_same() {
        let png = |color, depth, palette: &[u8], transparent: &[u8], samples: &[u8]| {
            let mut bytes = Vec::new();
            let mut encoder = Encoder::new(&mut bytes, 2, 1);
            encoder.set_color(color);
            encoder.set_depth(depth);
            if color == ColorType::Indexed {
                encoder.set_palette(palette.to_vec());
                encoder.set_trns(transparent.to_vec());
            }
            encoder.write_header().unwrap().write_image_data(samples).unwrap();
            let encoded = Encoded::open(&bytes).unwrap();
            assert_eq!(encoded.size(), (2, 1));
            encoded.pixels().unwrap()
        };
        let opaque = [[0, 255], [255, 255]];
        assert_eq!(png(ColorType::Grayscale, BitDepth::One, &[], &[], &[0b0100_0000]), opaque);
        assert_eq!(png(ColorType::Grayscale, BitDepth::Eight, &[], &[], &[0, 255]), opaque);
        assert_eq!(png(ColorType::Grayscale, BitDepth::Sixteen, &[], &[], &[0, 0, 255, 255]), opaque);
        assert_eq!(png(ColorType::Rgb, BitDepth::Eight, &[], &[], &[0, 0, 0, 255, 255, 255]), opaque);
        let half = [[0, 255], [255, 0]];
        assert_eq!(png(ColorType::GrayscaleAlpha, BitDepth::Eight, &[], &[], &[0, 255, 255, 0]), half);
        let rgba = [0, 0, 0, 255, 255, 255, 255, 0];
        assert_eq!(png(ColorType::Rgba, BitDepth::Eight, &[], &[], &rgba), half);
        let palette = [255, 255, 255, 0, 0, 0];
        assert_eq!(png(ColorType::Indexed, BitDepth::One, &palette, &[0], &[0b1000_0000]), half);
    }

    #[test]
    fn green_is_lighter_than_red_and_red_than_blue() {
        let colors = [[255, 0, 0], [0, 255, 0], [0, 0, 255], [255; 3]];
        assert_eq!(colors.map(luminance), [54, 182, 18, 255]);
    }
}
