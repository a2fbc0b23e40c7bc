//! Least squares of a few unknowns.

/// Unknowns of a plane over the features: the value at the pixel itself, and slopes over seven features.
pub const UNKNOWNS: usize = 8;
/// Entries on and above the diagonal of a symmetric matrix of them.
pub const MOMENTS: usize = UNKNOWNS * (UNKNOWNS + 1) / 2;
/// What is added to the moments of slopes, as a share of all weights: slopes over what hardly changes are not believed.
const RIDGE: [f64; UNKNOWNS] = [0.0, 0.003, 0.003, 0.01, 0.01, 0.01, 0.01, 0.01];

/// The values at the pixel, of three right hand sides, by the rows of the matrix of moments from the diagonal on;
/// `None` where there are no weights. Eliminated from the last unknown to the first, which is the one that is wanted.
pub fn values(moments: &[f32; MOMENTS], right: &[[f32; 3]; UNKNOWNS]) -> Option<[f32; 3]> {
    // Above a row are as many entries as the rows before it have from their diagonals on.
    let above = |row: usize| row * (2 * UNKNOWNS + 1 - row) / 2;
    let moment = |row: usize, column: usize| moments[above(row.min(column)) + row.abs_diff(column)];
    let mut matrix: [[f64; UNKNOWNS]; UNKNOWNS] =
        std::array::from_fn(|row| std::array::from_fn(|column| f64::from(moment(row, column))));
    let weights = matrix[0][0];
    if weights <= 0.0 {
        return None;
    }
    for k in 1..UNKNOWNS {
        matrix[k][k] += weights * RIDGE[k];
    }
    let mut right = right.map(|row| row.map(f64::from));
    for pivot in (1..UNKNOWNS).rev() {
        let (above, below) = matrix.split_at_mut(pivot);
        let (of_pivot, right_of_pivot) = (&below[0], right[pivot]);
        for (row, right) in above.iter_mut().zip(&mut right) {
            let factor = row[pivot] / of_pivot[pivot];
            row.iter_mut().zip(of_pivot).for_each(|(to, from)| *to -= factor * from);
            right.iter_mut().zip(right_of_pivot).for_each(|(to, from)| *to -= factor * from);
        }
    }
    let [first, ..] = matrix;
    (first[0] > 0.0).then(|| right[0].map(|x| (x / first[0]) as f32))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A plane over the features comes back, but for what the ridge takes.
    #[test]
    fn planes_are_found() {
        let (mut moments, mut right) = ([0.0; MOMENTS], [[0.0; 3]; UNKNOWNS]);
        for k in 0..200_u32 {
            let feature = |n: u32| ((k * 8 + n).wrapping_mul(2_654_435_761) >> 8) as f32 / 8_388_608.0 - 1.0;
            let row: [f32; UNKNOWNS] = std::array::from_fn(|n| if n == 0 { 1.0 } else { feature(n as u32) });
            let value = 3.0 + 0.5 * row[3] - 0.25 * row[7];
            let mut next = moments.iter_mut();
            for i in 0..UNKNOWNS {
                for j in i..UNKNOWNS {
                    if let Some(moment) = next.next() {
                        *moment += row[i] * row[j];
                    }
                }
                right[i] = std::array::from_fn(|c| right[i][c] + row[i] * value * (c + 1) as f32);
            }
        }
        let found = values(&moments, &right).expect("there are weights");
        for (c, found) in found.into_iter().enumerate() {
            assert!((found / (c + 1) as f32 - 3.0).abs() < 0.01, "{found}");
        }
        assert_eq!(values(&[0.0; MOMENTS], &[[0.0; 3]; UNKNOWNS]), None);
    }
}
