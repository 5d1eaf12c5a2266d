//! Writes GeoTIFFs, by the crate `tiff`.

use std::io::{self, Seek, Write};

use tiff::{
    Directory, TiffError,
    encoder::{
        Compression, DeflateLevel, Predictor, TiffEncoder, TiffKind, TiffKindBig, TiffKindStandard,
        TiffValue,
        colortype::{ColorType, Gray8, Gray16, Gray32, Gray32Float, Gray64Float, GrayI16, GrayI32},
    },
    tags::{Tag, Type},
};

use super::{
    super::{Samples, Surface},
    place::tags_of,
};

/// The form of a GeoTIFF that is written.
///
/// Needs the feature `geotiff`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct GeoTiffOptions {
    /// The compression of the samples. Whole numbers are compressed as differences.
    pub compression: TiffCompression,
    /// Writes a BigTIFF also where the file will be below 4 GiB. Off by default.
    pub big_tiff: bool,
}

/// A compression of the samples of a GeoTIFF; none loses anything.
///
/// Needs the feature `geotiff`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum TiffCompression {
    /// Not compressed.
    None,
    /// LZW, which old programs read, too.
    Lzw,
    /// Deflate, the smaller one.
    #[default]
    Deflate,
}

impl Surface {
    /// Writes the raster as a GeoTIFF of one band, in the type of its samples, with its place in the world
    /// and its number for 'no data'. A file that may be longer than 4 GiB becomes a BigTIFF.
    ///
    /// The file is written through `out` in small pieces: give one with a buffer, as
    /// [`BufWriter`](io::BufWriter) is.
    ///
    /// # Errors
    /// Errors of the writer.
    pub fn to_geotiff(&self, out: impl Write + Seek, options: &GeoTiffOptions) -> io::Result<()> {
        let bytes = self.samples.len() as u64 * self.samples.number_bytes() as u64;
        let written = if options.big_tiff || needs_places_of_eight_bytes(bytes, options.compression) {
            self.encode::<TiffKindBig>(out, options)
        } else {
            self.encode::<TiffKindStandard>(out, options)
        };
        written.map_err(|error| match error {
            TiffError::IoError(error) => error,
            error => io::Error::other(error),
        })
    }

    fn encode<K: TiffKind>(&self, out: impl Write + Seek, options: &GeoTiffOptions) -> Result<(), TiffError> {
        let compression = match options.compression {
            TiffCompression::None => Compression::Uncompressed,
            TiffCompression::Lzw => Compression::Lzw,
            TiffCompression::Deflate => Compression::Deflate(DeflateLevel::Balanced),
        };
        let is_plain = self.samples.are_floats() || options.compression == TiffCompression::None;
        let predictor = if is_plain { Predictor::None } else { Predictor::Horizontal };
        let encoder = TiffEncoder::<_, K>::new_generic(out)?;
        let encoder = encoder.with_compression(compression).with_predictor(predictor);
        match &self.samples {
            Samples::U8(all) => self.encode_as::<Gray8, K>(encoder, all),
            Samples::U16(all) => self.encode_as::<Gray16, K>(encoder, all),
            Samples::I16(all) => self.encode_as::<GrayI16, K>(encoder, all),
            Samples::U32(all) => self.encode_as::<Gray32, K>(encoder, all),
            Samples::I32(all) => self.encode_as::<GrayI32, K>(encoder, all),
            Samples::F32(all) => self.encode_as::<Gray32Float, K>(encoder, all),
            Samples::F64(all) => self.encode_as::<Gray64Float, K>(encoder, all),
        }
    }

    fn encode_as<C: ColorType, K: TiffKind>(
        &self,
        mut encoder: TiffEncoder<impl Write + Seek, K>,
        all: &[C::Inner],
    ) -> Result<(), TiffError>
    where
        [C::Inner]: TiffValue,
    {
        let mut image = encoder.new_image::<C>(self.width, self.height)?;
        for tag in tags_of(&self.georeference, self.height, self.no_data) {
            let Some(kind) = Type::from_u16(tag.kind) else { continue };
            let entry = image.encoder().write_entry_bytes(kind, &tag.bytes)?;
            let directory = Directory::from_iter([(Tag::from_u16_exhaustive(tag.tag), entry)]);
            image.encoder().extend_from(&directory);
        }
        image.write_data(all)
    }
}

/// Whether a file of so many bytes of samples may be longer than places of four bytes reach.
const fn needs_places_of_eight_bytes(samples: u64, compression: TiffCompression) -> bool {
    // The most that a compression makes of bytes that it cannot compress.
    let most = match compression {
        TiffCompression::Lzw => samples / 2 * 3,
        _ => samples + samples / 256,
    };
    // Room for the places and lengths of 2²⁰ strips, and for tags.
    most >= (1 << 32) - (1 << 25)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn large_files_are_big_tiffs() {
        for compression in [TiffCompression::None, TiffCompression::Lzw, TiffCompression::Deflate] {
            assert!(needs_places_of_eight_bytes(u64::from(u32::MAX) - (1 << 25), compression));
            assert!(!needs_places_of_eight_bytes(2 << 30, compression));
        }
        assert!(!needs_places_of_eight_bytes(4_000_000_000, TiffCompression::None));
        assert!(needs_places_of_eight_bytes(3_000_000_000, TiffCompression::Lzw));
    }
}
