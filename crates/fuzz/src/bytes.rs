//! Bytes that are taken off one after another, and mean something whatever they are.

/// Bytes that are not yet taken. At their end they are zeros.
pub(crate) struct Bytes<'d> {
    rest: &'d [u8],
}

impl<'d> Bytes<'d> {
    pub(crate) const fn new(rest: &'d [u8]) -> Self {
        Self { rest }
    }

    pub(crate) const fn is_empty(&self) -> bool {
        self.rest.is_empty()
    }

    pub(crate) fn byte(&mut self) -> u8 {
        let Some((&byte, rest)) = self.rest.split_first() else { return 0 };
        self.rest = rest;
        byte
    }

    /// A number below `end`, which is at most 256.
    pub(crate) fn below(&mut self, end: usize) -> usize {
        usize::from(self.byte()) % end
    }

    pub(crate) fn word(&mut self) -> u64 {
        (0..8).fold(0, |word, _| word << 8 | u64::from(self.byte()))
    }

    /// A number of any kind: mostly an ordinary one, else by its bits.
    pub(crate) fn number(&mut self) -> f64 {
        match self.byte() {
            0..128 => f64::from(self.byte()) / 8.0,
            128..160 => -f64::from(self.byte()) / 8.0,
            160..192 => f64::from(self.byte()) * 10.0_f64.powi(i32::from(self.byte() as i8) * 3),
            _ => f64::from_bits(self.word()),
        }
    }

    pub(crate) const fn rest(&self) -> &'d [u8] {
        self.rest
    }
}

/// The bytes before and after the first that is zero.
pub(crate) fn halves(data: &[u8]) -> (&[u8], &[u8]) {
    match data.iter().position(|&byte| byte == 0) {
        Some(at) => (&data[..at], &data[at + 1..]),
        None => (data, &[]),
    }
}
