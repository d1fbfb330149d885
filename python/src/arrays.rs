//! Arrays of numpy as rows of numbers, and back: whatever can be told from its type and shape is checked here.

use std::array::from_fn;
use std::borrow::Cow;

use hssh_metrics::Pose;
use nalgebra::{Matrix3, SMatrix};
use numpy::ndarray::{Ix1, Ix2};
use numpy::{Element, PyArray1, PyArrayMethods, PyReadonlyArrayDyn, PyUntypedArrayMethods};
use pyo3::exceptions::PyMemoryError;
use pyo3::prelude::*;

use crate::errors::{argument, wrong_type};

/// No array has more rows, nor more numbers.
const MOST_ROWS: usize = 1 << 26;
const MOST_NUMBERS: usize = 1 << 30;

/// An array of one type that is aligned, whatever its strides; of a list as well.
fn array<'py, T: Element>(
    name: &str,
    value: &Bound<'py, PyAny>,
    kinds: &str,
    dtype: &str,
) -> PyResult<PyReadonlyArrayDyn<'py, T>> {
    let numpy = value.py().import("numpy")?;
    let array = numpy
        .call_method1("asarray", (value,))
        .map_err(|problem| argument(format!("{name} cannot be an array: {}", problem.value(value.py()))))?;
    let found: char = array.getattr("dtype")?.getattr("kind")?.extract()?;
    let size: usize = array.getattr("size")?.extract()?;
    if size > MOST_NUMBERS {
        return Err(argument(format!(
            "{name} has {size} numbers, and {MOST_NUMBERS} are the most that are taken"
        )));
    }
    if !kinds.contains(found) && size > 0 {
        let found = array.getattr("dtype")?;
        return Err(wrong_type(format!("{name} must be an array of {}, not of {found}", words(kinds))));
    }
    let fit = numpy.call_method1("require", (array, dtype, "A"))?;
    fit.extract()
}

fn words(kinds: &str) -> &'static str {
    match kinds {
        "iu" => "integers",
        "b" => "bools",
        _ => "numbers",
    }
}

/// What is wrong with a shape.
fn misshapen(name: &str, wanted: &str, shape: &[usize]) -> PyErr {
    let dimensions: Vec<String> = shape.iter().map(usize::to_string).collect();
    let comma = if shape.len() == 1 { "," } else { "" };
    argument(format!("{name} must have the shape {wanted}, not ({}{comma})", dimensions.join(", ")))
}

/// Room for so many rows.
fn room<T>(name: &str, rows: usize) -> PyResult<Vec<T>> {
    if rows > MOST_ROWS {
        return Err(argument(format!("{name} has {rows} rows, and {MOST_ROWS} are the most that are taken")));
    }
    let mut room = Vec::new();
    room.try_reserve_exact(rows)
        .map_err(|_| PyMemoryError::new_err(format!("no memory for the {rows} rows of {name}")))?;
    Ok(room)
}

/// The numbers of an array row by row: as they lie there, if they lie so.
fn in_order<'a, T: Element + Copy>(
    name: &str,
    array: &'a PyReadonlyArrayDyn<'_, T>,
) -> PyResult<Cow<'a, [T]>> {
    if array.is_c_contiguous() {
        return array.as_slice().map(Cow::Borrowed).map_err(argument);
    }
    let mut numbers = Vec::new();
    numbers.try_reserve_exact(array.len()).map_err(|_| {
        PyMemoryError::new_err(format!("no memory for the {} numbers of {name}", array.len()))
    })?;
    numbers.extend(array.as_array().iter());
    Ok(Cow::Owned(numbers))
}

/// The rows of an (N, C) array of numbers, all finite.
pub(crate) fn table<const C: usize>(name: &str, value: &Bound<'_, PyAny>) -> PyResult<Vec<[f64; C]>> {
    let array = array::<f64>(name, value, "fiu", "float64")?;
    if array.shape() == [0] {
        return Ok(Vec::new());
    }
    if array.ndim() != 2 || array.shape()[1] != C {
        return Err(misshapen(name, &format!("(N, {C})"), array.shape()));
    }
    let mut rows = room(name, array.shape()[0])?;
    let numbers = in_order(name, &array)?;
    if let Some(place) = numbers.iter().position(|number| !number.is_finite()) {
        return Err(not_finite(name, &format!("{}, {}", place / C, place % C), numbers[place]));
    }
    rows.extend_from_slice(numbers.as_chunks().0);
    Ok(rows)
}

fn not_finite(name: &str, place: &str, number: f64) -> PyErr {
    argument(format!("{name}[{place}] is {number}, which is no finite number"))
}

/// The numbers of an (N,) array, all finite.
pub(crate) fn row(name: &str, value: &Bound<'_, PyAny>) -> PyResult<Vec<f64>> {
    let array = array::<f64>(name, value, "fiu", "float64")?;
    if array.ndim() != 1 {
        return Err(misshapen(name, "(N,)", array.shape()));
    }
    let view = array.as_array().into_dimensionality::<Ix1>().map_err(argument)?;
    let mut numbers: Vec<f64> = room(name, view.len())?;
    numbers.extend(view.iter());
    match numbers.iter().position(|number| !number.is_finite()) {
        Some(index) => Err(not_finite(name, &index.to_string(), numbers[index])),
        None => Ok(numbers),
    }
}

/// Rows of numbers of any length, all the same.
pub(crate) fn sweeps(name: &str, value: &Bound<'_, PyAny>) -> PyResult<Vec<Vec<f64>>> {
    let array = array::<f64>(name, value, "fiu", "float64")?;
    if array.ndim() != 2 {
        return Err(misshapen(name, "(N, B)", array.shape()));
    }
    let view = array.as_array().into_dimensionality::<Ix2>().map_err(argument)?;
    let mut rows = room(name, view.nrows())?;
    rows.extend(view.outer_iter().map(|row| row.to_vec()));
    Ok(rows)
}

/// The matrices of an (N, 3, 3) array, or the one of a (3, 3) array for all of N.
pub(crate) fn matrices(name: &str, value: &Bound<'_, PyAny>, count: usize) -> PyResult<Vec<Matrix3<f64>>> {
    let array = array::<f64>(name, value, "fiu", "float64")?;
    if array.shape() == [0] && count == 0 {
        return Ok(Vec::new());
    }
    let wanted = || misshapen(name, &format!("({count}, 3, 3) or (3, 3)"), array.shape());
    match *array.shape() {
        [3, 3] => Ok(vec![Matrix3::from_row_slice(&in_order(name, &array)?); count]),
        [given, 3, 3] if given == count => {
            let mut matrices = room(name, count)?;
            matrices.extend(in_order(name, &array)?.chunks_exact(9).map(Matrix3::from_row_slice));
            Ok(matrices)
        }
        _ => Err(wanted()),
    }
}

/// A (3, 3) array, or the three numbers of a diagonal.
pub(crate) fn covariance(name: &str, value: &Bound<'_, PyAny>) -> PyResult<[[f64; 3]; 3]> {
    let array = array::<f64>(name, value, "fiu", "float64")?;
    let view = array.as_array();
    match *array.shape() {
        [3] => Ok(from_fn(|row| from_fn(|column| if row == column { view[[row]] } else { 0.0 }))),
        [3, 3] => Ok(from_fn(|row| from_fn(|column| view[[row, column]]))),
        _ => Err(misshapen(name, "(3, 3), or (3,) for a diagonal", array.shape())),
    }
}

/// Three numbers.
pub(crate) fn triple(name: &str, value: &Bound<'_, PyAny>) -> PyResult<[f64; 3]> {
    let numbers = row(name, value)?;
    numbers[..].try_into().map_err(|_| misshapen(name, "(3,)", &[numbers.len()]))
}

/// The rows of an (N, C) array of indices, each below `end`.
pub(crate) fn indices<const C: usize>(
    name: &str,
    value: &Bound<'_, PyAny>,
    end: Option<usize>,
) -> PyResult<Vec<[u32; C]>> {
    let array = array::<i64>(name, value, "iu", "int64")?;
    if array.shape() == [0] {
        return Ok(Vec::new());
    }
    let shape = array.shape().to_vec();
    let is_row = C == 1 && shape.len() == 1;
    if !is_row && (shape.len() != 2 || shape[1] != C) {
        let wanted = if C == 1 { "(N,)".to_owned() } else { format!("(N, {C})") };
        return Err(misshapen(name, &wanted, &shape));
    }
    let mut rows = room(name, shape[0])?;
    let numbers = in_order(name, &array)?;
    let fits =
        |&index: &i64| u32::try_from(index).is_ok_and(|index| end.is_none_or(|end| (index as usize) < end));
    if let Some(place) = numbers.iter().position(|index| !fits(index)) {
        let given = numbers[place];
        let place = if is_row { place.to_string() } else { format!("{}, {}", place / C, place % C) };
        let most = end.map_or("as large".to_owned(), |end| format!("below {end}"));
        return Err(argument(format!("{name}[{place}] is {given}: indices count from 0 and are {most}")));
    }
    rows.extend(numbers.as_chunks::<C>().0.iter().map(|row| row.map(|index| index as u32)));
    Ok(rows)
}

/// Indices, or a mask of bools with one for each of `count`.
pub(crate) fn selection(name: &str, value: &Bound<'_, PyAny>, count: usize) -> PyResult<Vec<u32>> {
    let numpy = value.py().import("numpy")?;
    let kind: char = numpy.call_method1("asarray", (value,))?.getattr("dtype")?.getattr("kind")?.extract()?;
    if kind != 'b' {
        return Ok(indices::<1>(name, value, Some(count))?.into_iter().map(|[index]| index).collect());
    }
    let mask = array::<bool>(name, value, "b", "bool")?;
    if *mask.shape() != [count] {
        return Err(misshapen(name, &format!("({count},)"), mask.shape()));
    }
    let mask = mask.as_array();
    let chosen = mask.iter().enumerate().filter(|(_, chosen)| **chosen);
    Ok(chosen.map(|(index, _)| index as u32).collect())
}

/// The cells of an (H, W) array, and what kind of numbers they were; `uint8` and `int8` alike as 16 bits.
pub(crate) fn cells(name: &str, value: &Bound<'_, PyAny>) -> PyResult<(char, [usize; 2], Vec<i64>)> {
    let numpy = value.py().import("numpy")?;
    let kind: char = numpy.call_method1("asarray", (value,))?.getattr("dtype")?.getattr("kind")?.extract()?;
    if !"biu".contains(kind) {
        return Err(wrong_type(format!(
            "{name} must be an array of bools or integers: threshold probabilities first"
        )));
    }
    let array = array::<i64>(name, value, "biu", "int64")?;
    let [height, width] = *array.shape() else { return Err(misshapen(name, "(H, W)", array.shape())) };
    let mut cells = room(name, height.saturating_mul(width))?;
    cells.extend(array.as_array().iter());
    Ok((kind, [height, width], cells))
}

/// An array of a shape.
pub(crate) fn shaped<'py, T: Element, const D: usize>(
    py: Python<'py>,
    numbers: Vec<T>,
    shape: [usize; D],
) -> PyResult<Bound<'py, PyAny>> {
    PyArray1::from_vec(py, numbers).reshape(&shape[..]).map(Bound::into_any)
}

/// Poses as an (N, 3) array of x, y, θ.
pub(crate) fn poses<'py>(
    py: Python<'py>,
    poses: impl ExactSizeIterator<Item = Pose>,
) -> PyResult<Bound<'py, PyAny>> {
    let shape = [poses.len(), 3];
    shaped(py, poses.flat_map(|pose| [pose.x, pose.y, pose.theta]).collect(), shape)
}

/// Square matrices as an (N, D, D) array.
pub(crate) fn stack<'py, const D: usize>(
    py: Python<'py>,
    matrices: &[SMatrix<f64, D, D>],
) -> PyResult<Bound<'py, PyAny>> {
    let mut numbers: Vec<f64> = Vec::with_capacity(matrices.len() * D * D);
    for matrix in matrices {
        numbers.extend(matrix.transpose().iter());
    }
    shaped(py, numbers, [matrices.len(), D, D])
}

/// A square matrix as a (D, D) array.
pub(crate) fn square<'py, const D: usize>(
    py: Python<'py>,
    matrix: &SMatrix<f64, D, D>,
) -> PyResult<Bound<'py, PyAny>> {
    shaped(py, matrix.transpose().iter().copied().collect(), [D, D])
}

/// A pose of three numbers.
pub(crate) fn pose([x, y, theta]: [f64; 3]) -> Pose {
    Pose { x, y, theta }
}
