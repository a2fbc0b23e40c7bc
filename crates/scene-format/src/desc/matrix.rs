//! Matrices: three rows of four numbers.

use crate::codes;
use crate::diagnostic::{Diagnostic, Edit};
use crate::expression::Value;
use crate::form::Form;
use crate::read::{Reader, expected_for, hinted, is_expression};
use crate::schema::{FieldDef, MIN_LENGTH, Rule, Type, is_rows};
use crate::syntax::{Syntax, decode};
use crate::tree::{Item, Kind};
use crate::words::Words;

/// Three rows of four numbers, the last of which moves.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Rows(pub Box<[[f64; 4]; 3]>);

/// Below this share of the volume that columns of the same lengths could span, the rounding of the numbers decides
/// whether a matrix can be undone.
const SINGULAR: f64 = 1e-12;

/// How the numbers of a row are told apart.
const NAMES: [&str; 4] = ["the first number", "the second number", "the third number", "the fourth number"];

/// A row.
static ROW: FieldDef = FieldDef {
    name: "",
    noun: "a row of the matrix",
    doc: &[],
    kind: Type::List(&Type::Number),
    rule: Rule::within("a row", -1e12, 1e12),
    default: None,
};

impl Words for Rows {
    const TYPE: Type = Type::Rows;

    fn read(reader: &mut Reader<'_>, item: Item<'_, '_>, at: &'static FieldDef) -> Option<Self> {
        let value = reader.expression(item);
        if let Some(rows) = value.as_ref().and_then(|value| by_name(value.as_ref()?)) {
            return whole(reader, item, rows);
        }
        // An expression that is wrong was told.
        if let Some(None) = value {
            return None;
        }
        if !is_listed(item) {
            return reader.wrong_kind(item, at.noun, &expected_for(at, item), None);
        }
        if item.is_damaged() {
            return None;
        }
        let rows: Vec<Item<'_, '_>> = item.children().take(MANY).collect();
        let Ok(three) = <[Item<'_, '_>; 3]>::try_from(rows) else { return other_form(reader, item, at) };
        let counts = three.map(|row| is_listed(row).then(|| row.children().take(MANY).count()));
        // Which of three rows of three numbers is wrong nobody asks: all are.
        let row = |item: Item<'_, '_>| is_listed(item) || is_expression(item);
        if !three.into_iter().any(row) || counts[0] != Some(4) && counts.iter().all(|count| *count == counts[0]) {
            return other_form(reader, item, at);
        }
        let rows = three.map(|row| reader.numbers(row, &ROW, NAMES));
        let [Some(a), Some(b), Some(c)] = rows else { return None };
        whole(reader, item, [a, b, c])
    }

    fn form(&self, _all: bool) -> Form {
        let row = |row: &[f64; 4]| Form::Vector(row.iter().map(|&x| Form::Number(x)).collect());
        Form::Vector(self.0.iter().map(row).collect())
    }
}

/// Rows that stand in `vars`: three lists of four numbers.
fn by_name(value: &Value) -> Option<[[f64; 4]; 3]> {
    let Value::List(list) = value else { return None };
    let row = |row: &Value| -> Option<[f64; 4]> {
        let Value::List(row) = row else { return None };
        let number = |x: &Value| if let Value::Number(x) = x { Some(*x) } else { None };
        row.items().iter().map(number).collect::<Option<Vec<f64>>>()?.try_into().ok()
    };
    list.items().iter().map(row).collect::<Option<Vec<_>>>()?.try_into().ok()
}

/// A matrix that can be undone; another is told.
fn whole(reader: &mut Reader<'_>, item: Item<'_, '_>, rows: [[f64; 4]; 3]) -> Option<Rows> {
    if let Some(message) = fault(&rows) {
        reader.report(
            Diagnostic::error(codes::SINGULAR_TRANSFORM, item.head(), message)
                .expected("a matrix that can be undone: no scale of 0, no row made of the other two"),
        );
        return None;
    }
    Some(Rows(Box::new(rows)))
}

/// What is wrong with the numbers of a matrix.
fn fault(rows: &[[f64; 4]; 3]) -> Option<&'static str> {
    let column = |k: usize| [rows[0][k], rows[1][k], rows[2][k]];
    let largest = |column: [f64; 3]| column.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    let mut units = [[0.0; 3]; 3];
    for (k, unit) in units.iter_mut().enumerate() {
        let column = column(k);
        let most = largest(column);
        if most < MIN_LENGTH {
            return Some("the matrix is singular: it leaves nothing along one axis");
        }
        let scaled = column.map(|x| x / most);
        let length = scaled.iter().map(|x| x * x).sum::<f64>().sqrt();
        *unit = scaled.map(|x| x / length);
    }
    let [[a, b, c], [d, e, f], [g, h, i]] = units;
    let volume = a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g);
    (volume.abs() <= SINGULAR).then_some("the matrix is singular: it flattens everything to a plane, a line or a point")
}

/// More numbers than a matrix of any program has.
const MANY: usize = 17;

/// Brackets without a name.
fn is_listed(item: Item<'_, '_>) -> bool {
    matches!(item.kind(), Kind::List | Kind::Tuple) && item.name().is_none()
}

/// A matrix as other programs write it: reports it.
fn other_form<T>(reader: &mut Reader<'_>, item: Item<'_, '_>, at: &'static FieldDef) -> Option<T> {
    let (found, mended) = other(item);
    let message = format!("a matrix has three rows of four numbers, not {found}");
    let mut fault = Diagnostic::error(codes::WRONG_COUNT, item.head(), message).expected(expected_for(at, item));
    match mended {
        Some(mended) => {
            fault = fault.hint(format!("write {}", hinted(&mended)));
            fault.edit = Some(Edit { span: item.span(), replacement: mended });
        }
        None if found.contains("16 numbers") => {
            fault = fault.hint("glTF and pbrt list them by columns; the fourth row, 0, 0, 0, 1, is left out");
        }
        None if found.contains("12 numbers") => {
            fault = fault.hint("a matrix of POV-Ray lists them by columns; here each row has brackets of its own");
        }
        None => {}
    }
    reader.report(fault);
    None
}

/// What stands where three rows should, and what to write for it where that is certain.
fn other<'s>(item: Item<'_, 's>) -> (String, Option<String>) {
    let children: Vec<Item<'_, 's>> = item.children().take(MANY).collect();
    let row = |item: &Item<'_, 's>| -> Option<Vec<&'s str>> {
        let numbers: Vec<Item<'_, 's>> = item.children().take(MANY).collect();
        let all = is_listed(*item) && numbers.iter().all(|number| number.number().is_some());
        all.then(|| numbers.iter().map(|number| number.lexeme()).collect())
    };
    let flat: Option<Vec<&str>> =
        children.iter().map(|child| child.number().map(|_| child.lexeme())).collect::<Option<_>>();
    if let Some(flat) = flat {
        let rows = (flat.len() == 16).then(|| of_sixteen(&flat)).flatten();
        let found = match flat.len() {
            0 => "none".to_owned(),
            MANY => "so many".to_owned(),
            count => format!("{count} numbers in one row"),
        };
        return (found, rows.map(|rows| written(&rows, item.syntax())));
    }
    let Some(rows) = children.iter().map(row).collect::<Option<Vec<_>>>() else {
        return ("these".to_owned(), None);
    };
    let counts: Vec<usize> = rows.iter().map(Vec::len).collect();
    let found = match counts.as_slice() {
        [first, rest @ ..] if rest.iter().all(|count| count == first) => format!("{} rows of {first}", counts.len()),
        _ => format!("{} rows", counts.len()),
    };
    let three = match counts.as_slice() {
        [3, 3, 3] => Some([0, 1, 2].map(|k| [rows[k][0], rows[k][1], rows[k][2], "0"])),
        // The first of the columns: right, up, back, where it stands.
        [3, 3, 3, 3] => Some([0, 1, 2].map(|k| [0, 1, 2, 3].map(|column| rows[column][k]))),
        [4, 4, 4, 4] => by_rows(&rows.concat()).or_else(|| by_columns(&rows.concat())),
        _ => None,
    };
    (found, three.map(|rows| written(&rows, item.syntax())))
}

type Written<'s> = [[&'s str; 4]; 3];

/// Sixteen numbers by rows, where the last row is that of every such matrix.
fn by_rows<'s>(numbers: &[&'s str]) -> Option<Written<'s>> {
    let last = [12, 13, 14, 15].map(|k: usize| decode::number(numbers[k]));
    (last == [0.0, 0.0, 0.0, 1.0]).then(|| [0, 4, 8].map(|k: usize| [0, 1, 2, 3].map(|column| numbers[k + column])))
}

/// As [`by_rows`], by columns.
fn by_columns<'s>(numbers: &[&'s str]) -> Option<Written<'s>> {
    let turned: Vec<&str> = (0..16).map(|k| numbers[k % 4 * 4 + k / 4]).collect();
    by_rows(&turned)
}

/// Sixteen numbers in a row: by rows or by columns, where only one can be.
fn of_sixteen<'s>(numbers: &[&'s str]) -> Option<Written<'s>> {
    match (by_rows(numbers), by_columns(numbers)) {
        (Some(rows), None) => Some(rows),
        (None, Some(columns)) => Some(columns),
        _ => None,
    }
}

fn written(rows: &Written<'_>, syntax: Syntax) -> String {
    let rows = rows.map(|row| row.join(", "));
    match syntax {
        Syntax::Ron => format!("(({}), ({}), ({}))", rows[0], rows[1], rows[2]),
        Syntax::Toml | Syntax::Json => format!("[[{}], [{}], [{}]]", rows[0], rows[1], rows[2]),
    }
}

/// The rows in the brackets of `Matrix(..)` without their name, as they are written here.
pub(crate) fn unnamed_rows(body: Item<'_, '_>) -> Option<String> {
    let mut children = body.children();
    match (children.next(), children.next()) {
        // `{ Matrix = [[..], [..], [..]] }`
        _ if is_rows(body) => Some(body.lexeme().to_owned()),
        (Some(only), None) if is_rows(only) => Some(only.lexeme().to_owned()),
        (Some(only), None) if is_listed(only) => other(only).1,
        (Some(_), Some(_)) => {
            let rows: Vec<Item<'_, '_>> = body.children().take(MANY).collect();
            let four = |row: &Item<'_, '_>| is_listed(*row) && row.children().take(MANY).count() == 4;
            if rows.len() == 3 && rows.iter().all(four) {
                let rows: Vec<&str> = rows.iter().map(|row| row.lexeme()).collect();
                return Some(format!("({})", rows.join(", ")));
            }
            other(body).1
        }
        _ => None,
    }
}
