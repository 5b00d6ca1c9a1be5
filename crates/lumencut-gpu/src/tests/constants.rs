//! Numbers that mean something of their own are the same in WGSL and in Rust.

use std::collections::BTreeMap;

use lumencut_core::math::{blocks, hierarchy, lanes};
use naga::{Expression, Literal};

use crate::shader::assemble;

/// The constants of a room by name, as exact decimals.
fn constants(room: &str) -> BTreeMap<String, f64> {
    let module = naga::front::wgsl::parse_str(&assemble(room)).unwrap();
    let number = |expression| match module.global_expressions[expression] {
        Expression::Literal(Literal::F32(number)) => f64::from(number),
        Expression::Literal(Literal::U32(number)) => f64::from(number),
        Expression::Literal(Literal::I32(number)) => f64::from(number),
        ref other => panic!("not a number: {other:?}"),
    };
    let named = |constant: &naga::Constant| (constant.name.clone().unwrap(), number(constant.init));
    module.constants.iter().map(|(_, constant)| named(constant)).collect()
}

#[test]
fn sentinels_are_those_of_rust() {
    let expected = [
        ("FAN", lanes::FAN as f64),
        ("UNSET", f64::from(lanes::UNSET)),
        ("ABSENT", f64::from(lanes::ABSENT)),
        ("FAR", f64::from(lanes::FAR)),
        ("SETTLED", f64::from(lanes::SETTLED)),
        ("NO_SLOT", f64::from(hierarchy::NO_SLOT)),
        ("HUGE", f64::from(blocks::HUGE)),
    ];
    let expected: BTreeMap<_, _> = expected.map(|(name, number)| (name.to_owned(), number)).into();
    assert_eq!(constants("math/lanes"), expected);
}
