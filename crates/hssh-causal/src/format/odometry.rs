//! The odometry of a travel (τ of equation (4.1)) out of its record.

use crate::{Odometry, OdometryError};

use super::error::{Fault, Faults};
use super::record::{Record, Schema};
use super::tree::{Shape, Value};

const ODOMETRY: Schema = Schema {
    what: "an odometry",
    name: "Odometry",
    required: &["x", "y", "theta", "covariance"],
    optional: &[],
    example: "(x: 7.9, y: 0.1, theta: -1.57, covariance: [0.01, 0.01, 0.0004])",
};

const COVARIANCE: &str = "a covariance is three rows `[[xx, xy, xt], [xy, yy, yt], [xt, yt, tt]]`, or its diagonal `[xx, yy, tt]`, in m², m·rad and rad²";

const NUMBER: &str = "write a plain decimal number without a unit, like `7.9`, `-1.57` or `1e-4`; lengths are in metres, angles in radians";

/// Reads an odometry, noting what is wrong with it.
pub(super) fn read_odometry(value: &Value<'_>, faults: &mut Faults) -> Option<Odometry> {
    let record = Record::read(value, &ODOMETRY, faults)?;
    let mut number = |name| record.get(name).and_then(|value| faults.keep(read_number(value)));
    let (x, y, theta) = (number("x"), number("y"), number("theta"));
    let written = record.get("covariance")?;
    let covariance = faults.keep(read_covariance(written));
    let odometry = Odometry { x: x?, y: y?, theta: theta?, covariance: covariance? };
    let checked = odometry.check().map_err(|error| {
        let number = ["x", "y", "theta"].into_iter().zip([odometry.x, odometry.y, odometry.theta]);
        let is_it =
            |value: f64| matches!(error, OdometryError::OutOfProportion { value: bad, .. } if bad == value);
        let culprit = number.filter(|&(_, value)| is_it(value)).find_map(|(name, _)| record.get(name));
        no_measurement(&error, culprit.unwrap_or(written))
    });
    faults.keep(checked).map(|()| odometry)
}

/// Three rows of three, or the diagonal.
fn read_covariance(value: &Value<'_>) -> Result<[[f64; 3]; 3], Fault> {
    let items = three(value, "the covariance")?;
    if items.iter().all(|item| matches!(item.shape, Shape::List(_))) {
        let [first, second, third] = items;
        return Ok([read_row(first)?, read_row(second)?, read_row(third)?]);
    }
    if let Some(stray) = items.iter().find(|item| matches!(item.shape, Shape::List(_))) {
        return Err(Fault::new(stray.head(), "this covariance mixes rows and numbers", COVARIANCE));
    }
    let [xx, yy, tt] = read_row(value)?;
    Ok([[xx, 0.0, 0.0], [0.0, yy, 0.0], [0.0, 0.0, tt]])
}

fn read_row(value: &Value<'_>) -> Result<[f64; 3], Fault> {
    let [a, b, c] = three(value, "a row of the covariance")?;
    Ok([read_number(a)?, read_number(b)?, read_number(c)?])
}

fn three<'v, 'a>(value: &'v Value<'a>, what: &str) -> Result<&'v [Value<'a>; 3], Fault> {
    let Shape::List(items) = &value.shape else {
        return Err(Fault::new(
            value.head(),
            format!("{what} is a list, not {}", value.describe()),
            COVARIANCE,
        ));
    };
    <&[Value<'a>; 3]>::try_from(items.as_slice()).map_err(|_| {
        Fault::new(value.head(), format!("{what} has {} entries instead of 3", items.len()), COVARIANCE)
    })
}

/// A finite number.
fn read_number(value: &Value<'_>) -> Result<f64, Fault> {
    let (Shape::Number(written) | Shape::Word(written)) = value.shape else {
        return Err(Fault::new(
            value.head(),
            format!("expected a number, found {}", value.describe()),
            NUMBER,
        ));
    };
    match written.parse::<f64>() {
        Ok(number) if number.is_finite() => Ok(number),
        Ok(_) => Err(Fault::new(
            value.span,
            format!("`{written}` is not a finite number"),
            "a measurement is a finite number; leave out the whole `odometry` if there was none",
        )),
        Err(_) => Err(Fault::new(value.span, format!("`{written}` is not a number"), NUMBER)),
    }
}

/// Points into the covariance.
fn no_measurement(error: &OdometryError, covariance: &Value<'_>) -> Fault {
    let (span, help) = match *error {
        OdometryError::NotFinite(_) => (covariance.head(), COVARIANCE.to_owned()),
        OdometryError::OutOfProportion { .. } => (
            covariance.head(),
            "write metres and radians as they were measured, and leave out the whole `odometry` if there was none"
                .to_owned(),
        ),
        OdometryError::NotSymmetric { row, column, a, .. } => (
            entry(covariance, column, row).unwrap_or(covariance).span,
            format!("write the same number, {a}, in both places if that one is right"),
        ),
        OdometryError::NotPositiveDefinite(_) => {
            (covariance.head(), "every variance on the diagonal is positive, and every entry beside it is smaller than the square root of the product of its two variances".to_owned())
        }
    };
    Fault::new(span, error.to_string(), help)
}

/// An entry of a covariance written in rows, counted from 1.
fn entry<'v, 'a>(covariance: &'v Value<'a>, row: usize, column: usize) -> Option<&'v Value<'a>> {
    let Shape::List(rows) = &covariance.shape else { return None };
    let Shape::List(row) = &rows.get(row - 1)?.shape else { return None };
    row.get(column - 1)
}
