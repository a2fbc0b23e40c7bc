//! Vectors of three from and to the columns of a batch.

use super::batch::Columns;
use crate::lanes::Lanes;
use crate::math::V3;

impl<F: Lanes> V3<F> {
    /// Rows i .. i + N of three columns.
    #[inline(always)]
    pub fn load(columns: &Columns, i: usize) -> Self {
        V3(F::load(&columns[0][i..]), F::load(&columns[1][i..]), F::load(&columns[2][i..]))
    }
    /// Rows `index` of three columns.
    #[inline(always)]
    pub fn gather_columns(columns: &Columns, index: F::U) -> Self {
        V3(F::gather(&columns[0], index), F::gather(&columns[1], index), F::gather(&columns[2], index))
    }
    /// Into rows i .. i + N of three columns.
    #[inline(always)]
    pub fn store(self, columns: &mut Columns, i: usize) {
        self.0.store(&mut columns[0][i..]);
        self.1.store(&mut columns[1][i..]);
        self.2.store(&mut columns[2][i..]);
    }
    /// The lanes of the mask, packed, into the rows from i on.
    #[inline(always)]
    pub fn compress(self, mask: F::M, columns: &mut Columns, i: usize) {
        self.0.compress(mask, &mut columns[0][i..]);
        self.1.compress(mask, &mut columns[1][i..]);
        self.2.compress(mask, &mut columns[2][i..]);
    }
}
