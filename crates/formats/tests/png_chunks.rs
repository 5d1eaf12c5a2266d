//! The checksums of a PNG, for files that are changed and yet read to the end.

/// Gives each chunk the CRC of its content (PNG specification, annex D), up to the first that is not whole.
pub(crate) fn mend(png: &mut [u8]) {
    let mut at = 8;
    while let Some(length) = png.get(at..at + 4) {
        let length = length.iter().fold(0_usize, |length, &byte| length << 8 | usize::from(byte));
        let end = at + 8 + length;
        if png.len() < end + 4 {
            return;
        }
        let crc = crc(&png[at + 4..end]);
        png[end..end + 4].copy_from_slice(&crc);
        at = end + 4;
    }
}

fn crc(bytes: &[u8]) -> [u8; 4] {
    let step = |crc: u32| if crc & 1 == 1 { 0xedb8_8320 ^ crc >> 1 } else { crc >> 1 };
    let byte = |crc: u32, byte: &u8| (0..8).fold(crc ^ u32::from(*byte), |crc, _| step(crc));
    (!bytes.iter().fold(!0, byte)).to_be_bytes()
}
