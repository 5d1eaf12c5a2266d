//! Where output goes: buffered, and in color only for a terminal that wants it.

use std::{
    fmt::{self, Display},
    io::{self, BufWriter, IsTerminal, Write},
};

use anstream::{AutoStream, ColorChoice};
use anstyle::{Color, RgbColor, Style};

use crate::draw::theme::nearest_of_256;

/// The colors that a screen shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Depth {
    None,
    Palette,
    True,
}

/// Standard output.
pub(crate) struct Screen {
    out: BufWriter<Box<dyn Write>>,
    color: Depth,
    columns: usize,
}

impl Screen {
    /// The width where there is no terminal to ask.
    const COLUMNS: usize = 80;
    /// The widest picture or text, however wide the terminal.
    const MAX_COLUMNS: usize = 160;

    /// Colors are off when stdout is no terminal or `NO_COLOR` is set, on when `CLICOLOR_FORCE` is; `COLORTERM` says whether
    /// there are more than 256.
    pub(crate) fn stdout() -> Self {
        let stdout = io::stdout();
        let true_color = std::env::var("COLORTERM").is_ok_and(|term| term == "truecolor" || term == "24bit");
        let color = match AutoStream::choice(&stdout) {
            ColorChoice::Never => Depth::None,
            _ if true_color => Depth::True,
            _ => Depth::Palette,
        };
        let columns = stdout.is_terminal().then(|| terminal_size::terminal_size_of(&stdout)).flatten();
        let columns = columns.map_or(Self::COLUMNS, |(width, _)| usize::from(width.0).min(Self::MAX_COLUMNS));
        let out: Box<dyn Write> =
            if color == Depth::None { Box::new(stdout) } else { Box::new(AutoStream::auto(stdout)) };
        Self { out: BufWriter::with_capacity(1 << 16, out), color, columns }
    }

    /// Whether escape sequences for colors are welcome.
    pub(crate) fn has_color(&self) -> bool {
        self.color != Depth::None
    }

    /// A color, as near as the screen can show it.
    pub(crate) fn color(&self, rgb: RgbColor) -> Color {
        if self.color == Depth::True { rgb.into() } else { Color::from(nearest_of_256(rgb)) }
    }

    /// Text in a color.
    pub(crate) fn ink(&self, rgb: RgbColor) -> Style {
        Style::new().fg_color(Some(self.color(rgb)))
    }

    /// The width of a line.
    pub(crate) const fn columns(&self) -> usize {
        self.columns
    }

    /// Text in one color on another.
    pub(crate) fn ink_on(&self, ink: RgbColor, paper: RgbColor) -> Style {
        self.ink(ink).bg_color(Some(self.color(paper)))
    }

    /// Text in a style, or as it is where there is no color.
    pub(crate) fn paint<T: Display>(&self, style: Style, text: T) -> Painted<T> {
        Painted { style: if self.has_color() { style } else { Style::new() }, text }
    }
}

impl Write for Screen {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.out.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.out.flush()
    }
}

/// See [`Screen::paint`].
pub(crate) struct Painted<T> {
    style: Style,
    text: T,
}

impl<T: Display> Display for Painted<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let style = self.style;
        write!(f, "{style}{}{style:#}", self.text)
    }
}

/// Headings.
pub(crate) const BOLD: Style = Style::new().bold();
/// What matters less.
pub(crate) const DIM: Style = Style::new().dimmed();
