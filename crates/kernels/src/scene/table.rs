//! Tables that every lane looks up at a row of its own.

use crate::lanes::{Bits, Lanes};

/// Rows of K numbers. Up to 32 of them lie column by column, and registers are permuted to look them up; more lie row
/// by row, so that a lane finds its row in one or two lines of the cache.
#[derive(Clone)]
pub enum Table<const K: usize> {
    One([f32; K]),
    Sixteen(Box<[[f32; 16]; K]>),
    ThirtyTwo(Box<[[f32; 32]; K]>),
    /// Rows of [`Table::STRIDE`] numbers.
    Rows(Vec<f32>),
}

impl<const K: usize> Table<K> {
    /// From a row to the next, where they lie row by row: they are read by fours.
    const STRIDE: usize = K.next_multiple_of(4);

    pub fn new(rows: impl IntoIterator<Item = [f32; K]>) -> Self {
        let rows: Vec<[f32; K]> = rows.into_iter().collect();
        match rows.len() {
            1 => Table::One(rows[0]),
            0..=16 => Table::Sixteen(columns(&rows)),
            17..=32 => Table::ThirtyTwo(columns(&rows)),
            _ => {
                let mut numbers = vec![0.0; rows.len() * Self::STRIDE];
                for (to, row) in numbers.chunks_exact_mut(Self::STRIDE).zip(&rows) {
                    to[..K].copy_from_slice(row);
                }
                Table::Rows(numbers)
            }
        }
    }

    /// The row of each lane; anything of the table where there is none.
    #[inline(always)]
    pub fn row<F: Lanes>(&self, index: F::U) -> [F; K] {
        let mut row = [F::splat(0.0); K];
        match self {
            Table::One(only) => {
                for k in 0..K {
                    row[k] = F::splat(only[k]);
                }
            }
            Table::Sixteen(columns) => {
                for k in 0..K {
                    row[k] = F::gather(&columns[k], index);
                }
            }
            Table::ThirtyTwo(columns) => {
                for k in 0..K {
                    row[k] = F::gather(&columns[k], index);
                }
            }
            Table::Rows(numbers) => {
                let place = index * F::U::splat(Self::STRIDE as u32);
                for k in (0..K).step_by(4) {
                    let four = F::gather4(numbers, place + F::U::splat(k as u32));
                    let left = (K - k).min(4);
                    row[k..k + left].copy_from_slice(&four[..left]);
                }
            }
        }
        row
    }

    /// One number of each lane's row.
    #[inline(always)]
    pub fn column<F: Lanes>(&self, index: F::U, k: usize) -> F {
        match self {
            Table::One(only) => F::splat(only[k]),
            Table::Sixteen(columns) => F::gather(&columns[k], index),
            Table::ThirtyTwo(columns) => F::gather(&columns[k], index),
            Table::Rows(numbers) => {
                F::gather(numbers, index * F::U::splat(Self::STRIDE as u32) + F::U::splat(k as u32))
            }
        }
    }
}

fn columns<const K: usize, const N: usize>(rows: &[[f32; K]]) -> Box<[[f32; N]; K]> {
    let mut columns = Box::new([[0.0; N]; K]);
    for (i, row) in rows.iter().enumerate() {
        for (column, &number) in columns.iter_mut().zip(row) {
            column[i] = number;
        }
    }
    columns
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lanes::{ArrayF, ArrayU};

    /// Each layout gives back the rows that were put in, also where lanes want different ones.
    #[test]
    fn rows_are_found() {
        for rows in [1, 16, 17, 32, 33, 1000] {
            let value = |row: u32, k: usize| (10 * row) as f32 + k as f32;
            let table = Table::<5>::new((0..rows).map(|row| std::array::from_fn(|k| value(row, k))));
            for row in 0..rows {
                let lanes = [row, rows - 1 - row];
                let found = table.row::<ArrayF<2>>(ArrayU::load(&lanes));
                for (k, column) in found.into_iter().enumerate() {
                    let mut out = [0.0; 2];
                    column.store(&mut out);
                    assert_eq!(out, lanes.map(|row| value(row, k)), "{rows} rows, {lanes:?}, {k}");
                }
            }
        }
    }
}
