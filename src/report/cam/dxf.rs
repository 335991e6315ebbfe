//! Curves of a cam as a DXF file of release 12 (AC1009), which every CAD and
//! CAM program reads: one layer and one POLYLINE a curve, a CIRCLE for the base
//! circle, a POINT for the axis; millimetres.

use super::NamedCurve;
use std::fmt::Write as _;

/// Millimetres in a metre.
const MILLIMETRES: f64 = 1000.0;

/// Colour numbers of the layers, in turn.
const COLOURS: [u8; 6] = [7, 1, 5, 3, 6, 4];

/// The file. `base_radius` in metres.
pub fn dxf(curves: &[NamedCurve], base_radius: f64) -> String {
    let mut out = String::new();
    let mut pair = |code: u16, value: &str| {
        let _ = write!(out, "{code:>3}\r\n{value}\r\n");
    };
    pair(999, "dam: disc cam, millimetres");
    header(&mut pair, curves, base_radius);
    tables(&mut pair, curves);
    pair(0, "SECTION");
    pair(2, "ENTITIES");
    for curve in curves {
        polyline(&mut pair, curve);
    }
    pair(0, "CIRCLE");
    pair(8, "BASE_CIRCLE");
    point(&mut pair, [0.0, 0.0]);
    pair(40, &number(MILLIMETRES * base_radius));
    pair(0, "POINT");
    pair(8, "AXIS");
    point(&mut pair, [0.0, 0.0]);
    pair(0, "ENDSEC");
    pair(0, "EOF");
    out
}

fn header(pair: &mut impl FnMut(u16, &str), curves: &[NamedCurve], base_radius: f64) {
    let (mut low, mut high) = ([-base_radius; 2], [base_radius; 2]);
    for point in curves.iter().flat_map(|curve| &curve.polygon.points) {
        for axis in 0..2 {
            low[axis] = low[axis].min(point[axis]);
            high[axis] = high[axis].max(point[axis]);
        }
    }
    pair(0, "SECTION");
    pair(2, "HEADER");
    pair(9, "$ACADVER");
    pair(1, "AC1009");
    for (name, corner) in [("$EXTMIN", low), ("$EXTMAX", high)] {
        pair(9, name);
        point(pair, corner.map(|x| MILLIMETRES * x));
    }
    pair(0, "ENDSEC");
}

fn tables(pair: &mut impl FnMut(u16, &str), curves: &[NamedCurve]) {
    let names = curves.iter().map(|curve| layer(&curve.name));
    let layers: Vec<String> = names
        .chain(["BASE_CIRCLE".to_owned(), "AXIS".to_owned()])
        .collect();
    pair(0, "SECTION");
    pair(2, "TABLES");
    pair(0, "TABLE");
    pair(2, "LTYPE");
    pair(70, "1");
    pair(0, "LTYPE");
    pair(2, "CONTINUOUS");
    pair(70, "0");
    pair(3, "Solid line");
    pair(72, "65");
    pair(73, "0");
    pair(40, "0.0");
    pair(0, "ENDTAB");
    pair(0, "TABLE");
    pair(2, "LAYER");
    pair(70, &layers.len().to_string());
    for (index, name) in layers.iter().enumerate() {
        pair(0, "LAYER");
        pair(2, name);
        pair(70, "0");
        pair(62, &COLOURS[index % COLOURS.len()].to_string());
        pair(6, "CONTINUOUS");
    }
    pair(0, "ENDTAB");
    pair(0, "ENDSEC");
}

fn polyline(pair: &mut impl FnMut(u16, &str), curve: &NamedCurve) {
    let name = layer(&curve.name);
    pair(0, "POLYLINE");
    pair(8, &name);
    pair(66, "1");
    point(pair, [0.0, 0.0]);
    pair(70, if curve.polygon.closed { "1" } else { "0" });
    for &corner in &curve.polygon.points {
        pair(0, "VERTEX");
        pair(8, &name);
        point(pair, corner.map(|x| MILLIMETRES * x));
    }
    pair(0, "SEQEND");
    pair(8, &name);
}

fn point(pair: &mut impl FnMut(u16, &str), [x, y]: [f64; 2]) {
    pair(10, &number(x));
    pair(20, &number(y));
    pair(30, "0.0");
}

fn layer(name: &str) -> String {
    name.to_uppercase()
}

/// Plain decimals, a tenth of a nanometre fine.
fn number(value: f64) -> String {
    let text = format!("{value:.7}");
    match text
        .trim_start_matches('-')
        .bytes()
        .any(|c| (b'1'..=b'9').contains(&c))
    {
        true => text,
        false => "0.0".to_owned(),
    }
}
