//! `mediant moves`: the moves of N(k), its radius and its bounds.

use std::io::{self, Write};

use mediant::{
    Motion,
    moves::{
        BOUND_WITHOUT_CORNER_CUTTING, FiniteK, KError, Neighborhood, Parity, Quadrant, Vector,
        bound_at_centers, bound_at_corners, level, parents, smallest_k_at_centers, smallest_k_at_corners,
    },
};

use crate::{
    args::MovesArgs,
    draw::star,
    failure::Failure,
    terminal::{
        numbers::{grouped, percent_over},
        screen::{BOLD, DIM, Screen},
        table::{Align, TextTable},
    },
};

/// Runs the command.
pub(crate) fn moves(args: &MovesArgs, screen: &mut Screen) -> Result<(), Failure> {
    if let Some(k) = args.k() {
        let neighborhood = Neighborhood::new(k)?;
        facts(neighborhood, screen)?;
        if k.get() <= star::MAX_K {
            writeln!(screen)?;
            star::draw(neighborhood, screen)?;
        }
        writeln!(screen)?;
        list(neighborhood.quadrant(), screen)?;
    }
    match args.ratio {
        Some(ratio) => Ok(smallest(ratio, args.k().is_some(), screen)?),
        None if args.k().is_none() => Err(Failure::NoK),
        None => Ok(()),
    }
}

/// Writes the number of moves, the radius and the bounds.
fn facts(neighborhood: Neighborhood, screen: &mut Screen) -> Result<(), Failure> {
    let k = neighborhood.k();
    let radius = k.radius().map_err(|error: KError| Failure::K(error))?;
    let name = screen.paint(BOLD, format!("N({k})"));
    let quadrant = grouped(neighborhood.quadrant().len());
    writeln!(screen, "{name} · {} moves, {quadrant} in a closed quadrant", grouped(neighborhood.len()))?;
    writeln!(screen, "  radius          {}", grouped(radius.unsigned_abs().into()))?;
    let uncut = ("centers, never", BOUND_WITHOUT_CORNER_CUTTING);
    for (place, bound) in [("corners", bound_at_corners(k)), ("centers, one", bound_at_centers(k)), uncut] {
        // A bound close to 1 needs more digits to differ from 1.
        let digits = if bound < 1.001 { 6 } else { 2 };
        let percent = (bound - 1.0) * 100.0;
        writeln!(
            screen,
            "  {place:<15} Γ = {bound:.10}: never more than {percent:.digits$} % above any-angle"
        )?;
    }
    Ok(())
}

/// The number of moves that are listed at each end of a quadrant. A quadrant that has at most one more move
/// than the two ends is listed in full.
const SHOWN: u64 = 16;

/// Lists the moves of a quadrant.
fn list(quadrant: Quadrant, screen: &mut Screen) -> io::Result<()> {
    let heads = ["index", "move", "parity", "level", "length", "parents"];
    let align = |head| (head, if matches!(head, "parity" | "parents") { Align::Left } else { Align::Right });
    let len = quadrant.len();
    let left_out = len.saturating_sub(2 * SHOWN + 1);
    let mut table = TextTable::new(heads.map(align));
    let (first, last) = if left_out == 0 { (len, len) } else { (SHOWN, len - SHOWN) };
    for index in (0..first).chain(last..len) {
        if left_out > 0 && index == last {
            table.row(["…".to_owned()]);
        }
        table.row(move_cells(quadrant, index));
    }
    table.write(screen)?;
    if left_out > 0 {
        let note = format!(
            "  the first and last {SHOWN} of {}; {} lie between",
            grouped(len),
            grouped(len - 2 * SHOWN)
        );
        writeln!(screen, "{}", screen.paint(DIM, note))?;
    }
    Ok(())
}

/// The row of a move.
fn move_cells(quadrant: Quadrant, index: u64) -> [String; 6] {
    let v = quadrant.get(index).unwrap_or_default();
    let pair = |v: Vector| format!("({}, {})", v.x, v.y);
    let parity = match Quadrant::parity(index) {
        Parity::Odd => "odd",
        Parity::Even => "even",
    };
    [
        grouped(index),
        pair(v),
        parity.to_owned(),
        level(v).map_or_else(String::new, |level| level.to_string()),
        format!("{:.6}", v.norm()),
        parents(v).map_or_else(|| "axis".to_owned(), |(a, b)| format!("{} + {}", pair(a), pair(b))),
    ]
}

/// Writes the smallest k whose bound is at most `ratio`.
fn smallest(ratio: f64, after_moves: bool, screen: &mut Screen) -> io::Result<()> {
    if after_moves {
        writeln!(screen)?;
    }
    let target = if ratio < 1e6 {
        let percent = percent_over(ratio, if ratio < 1.001 { 6 } else { 2 });
        format!("At most {ratio} of an any-angle path's length ({percent})")
    } else {
        // Hundreds of digits would tell nobody anything.
        format!("At most {ratio:e} of an any-angle path's length")
    };
    writeln!(screen, "{}", screen.paint(BOLD, target))?;
    let places = [
        (
            "at corners",
            smallest_k_at_corners(ratio),
            "no k up to 2^20: the bound falls as 1 + 1/(8k²) and reaches 1 only in the limit",
        ),
        (
            "at centers",
            smallest_k_at_centers(ratio),
            "no k: more moves do not bring the bound below 3√2 − 3 ≈ 1.2426",
        ),
    ];
    for (place, k, none) in places {
        match k {
            Some(k) => writeln!(screen, "  {place}   k = {k}")?,
            None => writeln!(screen, "  {place}   {none}")?,
        }
    }
    if places.iter().any(|&(_, k, _)| k.is_some_and(|k| k.get() > Motion::MAX_K)) {
        let note = format!(
            "  `mediant run` takes k up to {}, or any; `mediant moves` up to {}",
            Motion::MAX_K,
            FiniteK::MAX_MOVES
        );
        writeln!(screen, "{}", screen.paint(DIM, note))?;
    }
    Ok(())
}
