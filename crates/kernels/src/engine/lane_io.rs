//! Vectors of three from and to the columns of a batch.

use super::batch::{Column, Columns};
use crate::lanes::Lanes;
use crate::math::V3;

/// A column, whether its length is known when compiled or not.
pub trait AsColumn {
    /// Its numbers.
    fn column(&self) -> &[f32];
}
impl AsColumn for Column<f32> {
    #[inline(always)]
    fn column(&self) -> &[f32] {
        self
    }
}
impl AsColumn for Vec<f32> {
    #[inline(always)]
    fn column(&self) -> &[f32] {
        self
    }
}

impl<F: Lanes> V3<F> {
    /// Rows i .. i + N of three columns.
    #[inline(always)]
    pub fn load(columns: &[impl AsColumn; 3], i: usize) -> Self {
        let [x, y, z] = columns;
        V3(F::load(&x.column()[i..]), F::load(&y.column()[i..]), F::load(&z.column()[i..]))
    }
    /// Rows `index` of three columns.
    #[inline(always)]
    pub fn gather_columns(columns: &[impl AsColumn; 3], index: F::U) -> Self {
        let [x, y, z] = columns;
        V3(F::gather(x.column(), index), F::gather(y.column(), index), F::gather(z.column(), index))
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
