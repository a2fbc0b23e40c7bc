//! Values of expressions.

use std::sync::Arc;

/// A value.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Value {
    Number(f64),
    Bool(bool),
    Pair([f64; 2]),
    Triple([f64; 3]),
    List(List),
}

/// A list. Copies share its items, so that lists of lists take no more memory than they are written with.
#[derive(Clone, Debug)]
pub(crate) struct List {
    items: Arc<[Value]>,
    /// Lists within it, one in the other.
    depth: u32,
}

/// Lists within each other, at most.
pub(crate) const MOST_LISTS: u32 = 16;

impl List {
    /// `None`: too many within each other.
    pub fn new(items: Vec<Value>) -> Option<List> {
        let depth = items.iter().map(|item| if let Value::List(list) = item { list.depth + 1 } else { 0 }).max();
        let depth = depth.unwrap_or(0);
        (depth < MOST_LISTS).then(|| List { items: items.into(), depth })
    }

    pub fn items(&self) -> &[Value] {
        &self.items
    }
}

/// Lists are the same if they are one list: to go through shared ones would have no end.
impl PartialEq for List {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.items, &other.items)
    }
}

impl Value {
    /// `a number`
    pub fn noun(&self) -> &'static str {
        match self {
            Value::Number(_) => "a number",
            Value::Bool(_) => "true or false",
            Value::Pair(_) => "a pair of numbers",
            Value::Triple(_) => "a vector",
            Value::List(_) => "a list",
        }
    }

    /// The numbers that it is made of; none of lists and truth values.
    pub fn numbers(&self) -> &[f64] {
        match self {
            Value::Number(x) => std::slice::from_ref(x),
            Value::Pair(pair) => pair,
            Value::Triple(triple) => triple,
            Value::Bool(_) | Value::List(_) => &[],
        }
    }

    /// A value of so many numbers.
    pub fn of(numbers: &[f64]) -> Option<Value> {
        match *numbers {
            [x] => Some(Value::Number(x)),
            [x, y] => Some(Value::Pair([x, y])),
            [x, y, z] => Some(Value::Triple([x, y, z])),
            _ => None,
        }
    }

    /// Number by number.
    pub fn map(&self, f: impl Fn(f64) -> f64) -> Option<Value> {
        Some(match self {
            Value::Number(x) => Value::Number(f(*x)),
            Value::Pair(pair) => Value::Pair(pair.map(f)),
            Value::Triple(triple) => Value::Triple(triple.map(f)),
            Value::Bool(_) | Value::List(_) => return None,
        })
    }

    /// Number by number of two; a single number goes with all of the other's.
    pub fn zip(&self, other: &Value, f: impl Fn(f64, f64) -> f64) -> Option<Value> {
        // As nearly all of a million are.
        if let (Value::Number(a), Value::Number(b)) = (self, other) {
            return Some(Value::Number(f(*a, *b)));
        }
        let (a, b) = (self.numbers(), other.numbers());
        let count = a.len().max(b.len());
        if a.is_empty() || b.is_empty() || (a.len() != b.len() && a.len() != 1 && b.len() != 1) {
            return None;
        }
        let of = |numbers: &[f64], k: usize| numbers[if numbers.len() == 1 { 0 } else { k }];
        let mut numbers = [0.0; 3];
        for (k, number) in numbers[..count].iter_mut().enumerate() {
            *number = f(of(a, k), of(b, k));
        }
        Value::of(&numbers[..count])
    }

    /// Whether all of its numbers are finite.
    pub fn is_finite(&self) -> bool {
        match self {
            // Its items were looked at when it was made.
            Value::List(_) => true,
            _ => self.numbers().iter().all(|x| x.is_finite()),
        }
    }
}
