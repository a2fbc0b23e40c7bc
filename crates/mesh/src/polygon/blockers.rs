//! Corners of a flat polygon that can lie in an ear, sorted by place, so that an ear is tested against those near it.

/// A grid of cells with about one corner in each, its shape that of the corners' box.
#[derive(Default)]
pub(super) struct BlockerGrid {
    corners: Vec<u32>,
    /// Where each cell's part of `corners` starts, row by row; one entry more than there are cells.
    starts: Vec<u32>,
    low: [f64; 2],
    extent: [f64; 2],
    /// Columns and rows.
    cells: [usize; 2],
    /// For each corner of the polygon, whether it is here.
    holds: Vec<bool>,
    /// How many corners here were cut off.
    removed: usize,
}

/// Whether a corner was found, and how many corners and rows of cells were looked at.
pub(super) struct Search {
    pub(super) found: bool,
    pub(super) cost: u64,
}

/// An interval of x.
#[derive(Clone, Copy)]
struct Span {
    from: f64,
    to: f64,
}

impl BlockerGrid {
    /// Notes that a corner was cut off, if it was here at all; says when so many were that they cost more than a new
    /// grid.
    pub(super) fn is_stale_after_removing(&mut self, corner: u32) -> bool {
        self.removed += usize::from(self.holds[corner as usize]);
        // The square root of the number of corners balances the tests of dead ones against the work of a new grid.
        self.removed > 16 && (self.removed - 16) * (self.removed - 16) > 4 * self.corners.len()
    }

    /// The corners, whose memory can be used again.
    pub(super) fn take_corners(&mut self) -> Vec<u32> {
        std::mem::take(&mut self.corners)
    }

    /// The cell along an axis; outside points belong to the border cells.
    fn cell_along(&self, axis: usize, coordinate: f64) -> usize {
        let part = if self.extent[axis] > 0.0 { (coordinate - self.low[axis]) / self.extent[axis] } else { 0.0 };
        // A conversion from float to integer saturates.
        ((part * self.cells[axis] as f64) as usize).min(self.cells[axis] - 1)
    }

    /// Sorts these corners, at their places in `flat`, into cells.
    pub(super) fn fill(&mut self, corners: Vec<u32>, flat: &[[f64; 2]]) {
        self.corners = corners;
        self.removed = 0;
        self.holds.clear();
        self.holds.resize(flat.len(), false);
        let mut low = [f64::INFINITY; 2];
        let mut high = [f64::NEG_INFINITY; 2];
        for &corner in &self.corners {
            self.holds[corner as usize] = true;
            for axis in 0..2 {
                low[axis] = low[axis].min(flat[corner as usize][axis]);
                high[axis] = high[axis].max(flat[corner as usize][axis]);
            }
        }
        self.low = low;
        self.extent = [high[0] - low[0], high[1] - low[1]];
        let count = self.corners.len().max(1);
        // Square cells: columns * rows = count, columns / rows = width / height. Without a height there is one row.
        let columns = (count as f64 * self.extent[0] / self.extent[1]).sqrt().ceil();
        let columns = if columns.is_nan() { 1 } else { (columns as usize).clamp(1, count) };
        self.cells = [columns, count.div_ceil(columns)];
        let cell_of = |grid: &BlockerGrid, corner: u32| {
            let [x, y] = flat[corner as usize];
            grid.cell_along(1, y) * grid.cells[0] + grid.cell_along(0, x)
        };
        // Counting sort: number per cell, then each cell's end, then fill from the back.
        let mut starts = std::mem::take(&mut self.starts);
        starts.clear();
        starts.resize(self.cells[0] * self.cells[1] + 1, 0_u32);
        for &corner in &self.corners {
            starts[cell_of(self, corner)] += 1;
        }
        let mut end = 0;
        for start in &mut starts {
            end += *start;
            *start = end;
        }
        let mut sorted = vec![0; self.corners.len()];
        for &corner in &self.corners {
            let start = &mut starts[cell_of(self, corner)];
            *start -= 1;
            sorted[*start as usize] = corner;
        }
        self.corners = sorted;
        self.starts = starts;
    }

    /// Whether `test` holds for any corner in the cells that the triangle touches.
    pub(super) fn any_near(&self, triangle: [[f64; 2]; 3], test: impl Fn(u32) -> bool) -> Search {
        let mut search = Search { found: false, cost: 0 };
        if self.corners.is_empty() {
            return search;
        }
        let [low, high] = [f64::min, f64::max]
            .map(|pick| [0, 1].map(|axis| pick(pick(triangle[0][axis], triangle[1][axis]), triangle[2][axis])));
        // Far above rounding, far below the size of a cell.
        let margin = [0, 1].map(|axis| 1e-7 * self.extent[axis].max(high[axis] - low[axis]));
        let height = self.extent[1] / self.cells[1] as f64;
        for row in self.cell_along(1, low[1] - margin[1])..=self.cell_along(1, high[1] + margin[1]) {
            search.cost += 1;
            let bottom = self.low[1] + row as f64 * height;
            let Some(span) = span_in_strip(triangle, bottom - margin[1], bottom + height + margin[1]) else { continue };
            let first = row * self.cells[0] + self.cell_along(0, span.from - margin[0]);
            let last = row * self.cells[0] + self.cell_along(0, span.to + margin[0]);
            // The cells of one row lie side by side.
            for &corner in &self.corners[self.starts[first] as usize..self.starts[last + 1] as usize] {
                search.cost += 1;
                if test(corner) {
                    search.found = true;
                    return search;
                }
            }
        }
        search
    }
}

/// The x that a triangle has between two heights.
fn span_in_strip(triangle: [[f64; 2]; 3], bottom: f64, top: f64) -> Option<Span> {
    let mut span: Option<Span> = None;
    let mut add = |x: f64| {
        let now = span.unwrap_or(Span { from: x, to: x });
        span = Some(Span { from: now.from.min(x), to: now.to.max(x) });
    };
    for (a, b) in [(0, 1), (1, 2), (2, 0)] {
        let ([ax, ay], [bx, by]) = (triangle[a], triangle[b]);
        if (bottom..=top).contains(&ay) {
            add(ax);
        }
        for y in [bottom, top] {
            if (ay < y) != (by < y) {
                add(ax + (bx - ax) * ((y - ay) / (by - ay)).clamp(0.0, 1.0));
            }
        }
    }
    span
}
