//! Standard output: buffered, and in color only where that is wanted.

use std::{
    fmt::{self, Display},
    io::{self, BufWriter, IsTerminal, Write},
};

use anstream::{AutoStream, ColorChoice};
use anstyle::{Color, RgbColor, Style};

use super::palette::nearest_of_256;

/// The colors that a screen shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Depth {
    None,
    /// 256 colors.
    Palette,
    /// All colors.
    True,
}

/// Standard output.
pub(crate) struct Screen {
    out: BufWriter<Box<dyn Write>>,
    color: Depth,
    columns: usize,
}

impl Screen {
    /// The width if stdout is no terminal.
    const COLUMNS: usize = 80;
    /// The widest picture or text, however wide the terminal.
    const MAX_COLUMNS: usize = 160;

    /// Standard output. Colors are off if it is no terminal or `NO_COLOR` is set, on if `CLICOLOR_FORCE` is
    /// set; `COLORTERM` says whether there are more than 256.
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

    /// Whether output may have escape sequences for colors.
    pub(crate) fn has_color(&self) -> bool {
        self.color != Depth::None
    }

    /// A color, as near as the screen can show it.
    pub(crate) fn color(&self, rgb: RgbColor) -> Color {
        if self.color == Depth::True { rgb.into() } else { Color::from(nearest_of_256(rgb)) }
    }

    /// The style of text in a color.
    pub(crate) fn ink(&self, rgb: RgbColor) -> Style {
        Style::new().fg_color(Some(self.color(rgb)))
    }

    /// The width of a line, in characters.
    pub(crate) const fn columns(&self) -> usize {
        self.columns
    }

    /// The style of text in one color on another.
    pub(crate) fn ink_on(&self, ink: RgbColor, paper: RgbColor) -> Style {
        self.ink(ink).bg_color(Some(self.color(paper)))
    }

    /// Text in a style; without color, as it is.
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

/// Text in a style: what [`Screen::paint`] returns.
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

/// The style of headings.
pub(crate) const BOLD: Style = Style::new().bold();
/// The style of what matters less.
pub(crate) const DIM: Style = Style::new().dimmed();
