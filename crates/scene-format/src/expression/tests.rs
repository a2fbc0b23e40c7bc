use super::*;
use crate::codes;

fn value(text: &str) -> Value {
    let mut names = |name: &str| match name {
        "r" => Named::Value(Value::Number(3.0)),
        "p" => Named::Value(Value::Triple([1.0, 2.0, 3.0])),
        "list" => List::new(vec![Value::Number(7.0), Value::Triple([4.0, 5.0, 6.0])])
            .map_or(Named::Failed, |list| Named::Value(Value::List(list))),
        _ => Named::Unknown(vec!["r".to_owned()]),
    };
    evaluate(text, &mut names).unwrap_or_else(|fault| panic!("{text}: {fault:?}"))
}

fn number(text: &str) -> f64 {
    match value(text) {
        Value::Number(number) => number,
        other => panic!("{text}: {other:?}"),
    }
}

#[test]
fn arithmetic_as_on_paper() {
    for (text, expected) in [
        ("1 + 2*3", 7.0),
        ("(1+2)*3", 9.0),
        ("-2^2", -4.0),
        ("2^3^2", 512.0),
        ("2^-1", 0.5),
        ("7 - 2 - 1", 4.0),
        ("12/2/3", 2.0),
        ("-7 % 3", 2.0),
        ("7 % -3", -2.0),
        ("1_000 + .5 + 1. + 2e-1", 1001.7),
        ("r*r", 9.0),
        ("p.y + p.b + p[0]", 6.0),
        ("list[1].z - list[0]", -1.0),
        ("sin(30) + cos(60)", 1.0),
        ("sin(180) + cos(90) + tan(0)", 0.0),
        ("atan2(1, 1) + asin(1)", 135.0),
        ("max(1, 2, r) + min(4, r)", 6.0),
        ("clamp(9, 0, 2) + mix(1, 3, 0.5) + step(1, 2) + smoothstep(0, 2, 1)", 5.5),
        ("length((3, 4)) + dot(p, p)", 19.0),
        ("if(r > 2 && !(r == 4) || false, 1, 2)", 1.0),
        ("len(list) + len(p)", 5.0),
        ("keyframes(-1, 0, 5, 2, 7) + keyframes(9, 0, 5, 2, 7)", 12.0),
        ("keyframes(1, 0, 5, 2, 7) + keyframes(2, 0, 5, 2, 7, 3, 0) + keyframes(1, 0, p, 2, 3*p).y", 17.0),
    ] {
        assert!((number(text) - expected).abs() < 1e-12, "{text} = {}", number(text));
    }
}

#[test]
fn vectors_go_component_by_component() {
    assert_eq!(value("2*p + (1, 0, -1)"), Value::Triple([3.0, 4.0, 5.0]));
    assert_eq!(value("cross((1,0,0), (0,1,0))"), Value::Triple([0.0, 0.0, 1.0]));
    assert_eq!(value("normalize((0, 0, 9))"), Value::Triple([0.0, 0.0, 1.0]));
    assert_eq!(value("-(1, 2)"), Value::Pair([-1.0, -2.0]));
    assert_eq!(value("#ffffff * 0.5"), Value::Triple([0.5; 3]));
    assert_eq!(value("hsv(120, 1, 1)"), Value::Triple([0.0, 1.0, 0.0]));
    let Value::Triple([r, g, b]) = value("blackbody(2700)") else { panic!("a colour") };
    assert!(r > g && g > b && (0.2126 * r + 0.7152 * g + 0.0722 * b - 1.0).abs() < 1e-12, "{r} {g} {b}");
    assert_eq!(value("p == (1, 2, 3)"), Value::Bool(true));
}

#[test]
fn random_numbers_are_spread_and_repeat_themselves() {
    let of = |k: u32| number(&format!("random({k}, 5)"));
    assert_eq!(of(3), of(3));
    let mean = (0..4000).map(of).sum::<f64>() / 4000.0;
    // Four standard errors of a mean of 4000.
    assert!((mean - 0.5).abs() < 4.0 * 0.289 / 4000f64.sqrt(), "{mean}");
    assert_ne!(number("random(1, 2)"), number("random(2, 1)"));
    assert_eq!(number("random(0)"), number("random(-0)"));
}

#[test]
fn faults_say_where() {
    let fault = |text: &str| {
        let result = evaluate(text, &mut |_| Named::Unknown(Vec::new()));
        let fault = result.expect_err(text).expect("told");
        (fault.code, fault.at)
    };
    assert_eq!(fault("1 + 2 +"), (codes::EXPRESSION_SYNTAX, 7..7));
    assert_eq!(fault("1 + x*2"), (codes::EXPRESSION_NAME, 4..5));
    assert_eq!(fault("(1, 2) + (1, 2, 3)"), (codes::EXPRESSION_TYPE, 7..8));
    assert_eq!(fault("3/(2-2)"), (codes::EXPRESSION_NOT_FINITE, 1..2));
    assert_eq!(fault("(1,2,3)[7]"), (codes::EXPRESSION_INDEX, 8..9));
    for wrong in [
        "keyframes(1)",
        "keyframes(1, 2)",
        "keyframes(1, 0, 1, 0, 2)",
        "keyframes(1, 0, (1, 2), 1, 2)",
        "keyframes(0, 1, true)",
    ] {
        assert_eq!(fault(wrong), (codes::EXPRESSION_TYPE, 0..9));
    }
    assert_eq!(fault("log(-1)"), (codes::EXPRESSION_NOT_FINITE, 0..3));
    assert_eq!(fault("é"), (codes::EXPRESSION_NAME, 0..2));
    assert_eq!(fault("1 €"), (codes::EXPRESSION_SYNTAX, 2..5));
}

#[test]
fn what_is_not_chosen_may_have_no_value() {
    assert_eq!(number("if(1 > 2, 1/0, 0.5)"), 0.5);
    assert_eq!(number("if(true, 3, log(0) + (1, 2)[5] + (1, 2).z + (1, 2)*(1, 2, 3))"), 3.0);
    assert_eq!(number("if(false, if(true, 1/0, 2), if(2 > 1, 4, 1/0))"), 4.0);
    assert_eq!(value("true || 1/0 > 1"), Value::Bool(true));
    assert_eq!(value("false && 1/0 > 1"), Value::Bool(false));
    let fault = |text: &str| evaluate(text, &mut |_| Named::Unknown(Vec::new())).expect_err(text).expect("told").code;
    // It must be an expression of names that are there; and what is chosen must have a value.
    assert_eq!(fault("if(true, 1, 2 +)"), codes::EXPRESSION_SYNTAX);
    assert_eq!(fault("if(true, 1, nobody)"), codes::EXPRESSION_NAME);
    assert_eq!(fault("if(true, 1/0, 2)"), codes::EXPRESSION_NOT_FINITE);
    assert_eq!(fault("if(true, 1, 2) + 1/0"), codes::EXPRESSION_NOT_FINITE);
    assert_eq!(fault("true && 1/0 > 1"), codes::EXPRESSION_NOT_FINITE);
}

/// Nothing that is written ends the program, nests too deep or takes long.
#[test]
fn hostile_texts_are_refused() {
    for text in
        ["(".repeat(4000), "-".repeat(4000), "2^".repeat(2000), "abs(".repeat(1000), "[".repeat(99), "1".repeat(5000)]
    {
        assert!(evaluate(&text, &mut |_| Named::Unknown(Vec::new())).is_err());
    }
    let mut state = 7u64;
    let pieces = [
        "1", "r", "(", ")", ",", "+", "-", "*", "/", "%", "^", "[", "]", ".", "x", "<", "==", "&&", "!", "#ff", "é",
        " ", "if(", "1e", "p",
    ];
    for _ in 0..20_000 {
        let mut text = String::new();
        for _ in 0..12 {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            text += pieces[(state >> 33) as usize % pieces.len()];
        }
        let _ = evaluate(&text, &mut |_| Named::Value(Value::Triple([1.0, 0.0, 2.0])));
    }
}
