//! Writes ESRI ASCII grids.

use std::io::{self, Write};

use super::super::{
    Samples, Surface,
    georeference::{Georeference, Origin},
    samples::each,
};

impl Surface {
    /// Writes the raster as an ESRI ASCII grid. Numbers have as many digits as tell them from all others of
    /// their type. Floats have a point or an exponent, so that they are read as such; so have the numbers of
    /// a raster with integers of 2³¹ or more, which GDAL would cut to 32 bits. Without a cell size cells are
    /// 1 × 1, and without a place the lower left corner is (0, 0). Cells that are not square have `dx` and
    /// `dy`, which GDAL reads and ArcGIS does not.
    ///
    /// A header always names a number for 'no data', since −9999 counts as such otherwise: the raster's, or
    /// the first of −9999, −99999, … that no cell has. NaN is written as that number.
    ///
    /// # Errors
    /// Errors of the writer.
    pub fn to_esri_ascii(&self, mut out: impl Write) -> io::Result<()> {
        let Georeference { cell_size, origin, .. } = self.georeference;
        let (width, height) = cell_size.unwrap_or((1.0, 1.0));
        let Origin { x, y, is_center } = origin.unwrap_or(Origin { x: 0.0, y: 0.0, is_center: false });
        let of = if is_center { "center" } else { "corner" };
        write!(out, "ncols {}\nnrows {}\nxll{of} {x}\nyll{of} {y}\n", self.width, self.height)?;
        if width == height {
            writeln!(out, "cellsize {width}")?;
        } else {
            write!(out, "dx {width}\ndy {height}\n")?;
        }
        let no_data = match self.marker {
            Some(marker) => self.word(marker),
            None => self.unused().to_string(),
        };
        writeln!(out, "NODATA_value {no_data}")?;
        let end = if self.has_large_integers() { ".0" } else { "" };
        let mut row = Vec::new();
        let columns = self.width as usize;
        for start in (0..self.samples.len()).step_by(columns) {
            row.clear();
            each!(&self.samples, all => {
                for (x, number) in all[start..][..columns].iter().enumerate() {
                    if x > 0 {
                        row.push(b' ');
                    }
                    if self.samples.get(start + x).is_some_and(f64::is_nan) {
                        row.extend(no_data.as_bytes());
                    } else {
                        write!(row, "{number:?}{end}")?;
                    }
                }
            });
            row.push(b'\n');
            out.write_all(&row)?;
        }
        Ok(())
    }

    /// A number in the digits of the samples' type.
    fn word(&self, number: f64) -> String {
        match self.samples {
            Samples::F32(_) => format!("{:?}", number as f32),
            Samples::F64(_) => format!("{number:?}"),
            _ => number.to_string(),
        }
    }

    fn has_large_integers(&self) -> bool {
        matches!(&self.samples, Samples::U32(all) if all.iter().any(|&number| number > i32::MAX as u32))
    }

    /// −9999, or with more nines, so that no cell has it; NaN if cells have all of them.
    fn unused(&self) -> f64 {
        let is_used = |number| (0..self.samples.len()).any(|at| self.samples.get(at) == Some(number));
        let all = std::iter::successors(Some(-9999.0_f64), |number| Some(number * 10.0 - 9.0));
        all.take_while(|number| number.is_finite()).find(|&number| !is_used(number)).unwrap_or(f64::NAN)
    }
}
