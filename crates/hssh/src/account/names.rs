//! Names that people give to regions, by a point in each.

/// A name for what is at a point.
#[derive(Clone, PartialEq, Debug)]
pub struct PointName {
    /// Metres in the frame of the map.
    pub point: [f64; 2],
    /// What it is called.
    pub name: String,
}

/// What is wrong with a line of names.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[error("line {line}: {problem}; write `x,y,name`, such as `2.5,-1,kitchen`")]
pub struct NamesError {
    /// The line, counted from 1.
    pub line: usize,
    /// What is wrong with it.
    pub problem: String,
}

impl PointName {
    /// Reads lines of `x,y,name`. Empty lines and those that begin with `#` do not count, nor does a first line that
    /// says what the columns are.
    ///
    /// # Errors
    /// If a line is not of that form.
    pub fn read_all(text: &str) -> Result<Vec<Self>, NamesError> {
        let mut names = Vec::new();
        for (number, line) in (1..).zip(text.trim_start_matches('\u{feff}').lines()) {
            let line = line.trim();
            let is_heading = number == 1 && line.to_ascii_lowercase().starts_with("x,");
            if line.is_empty() || line.starts_with('#') || is_heading {
                continue;
            }
            let wrong = |problem: &str| NamesError { line: number, problem: problem.to_owned() };
            let mut fields = line.splitn(3, ',').map(str::trim);
            let mut metres = || {
                let field = fields.next()?.parse::<f64>().ok();
                field.filter(|metres| metres.is_finite())
            };
            let (Some(x), Some(y)) = (metres(), metres()) else {
                return Err(wrong("it does not begin with two numbers of metres"));
            };
            let name = fields.next().unwrap_or_default().trim_matches('"').trim();
            if name.is_empty() {
                return Err(wrong("the name is missing"));
            }
            names.push(PointName { point: [x, y], name: name.to_owned() });
        }
        Ok(names)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_read_line_by_line() {
        let read =
            PointName::read_all("x,y,name\n1, 2.5 ,kitchen\n\n# no room\n-3,0,\"lab, upper\"\r\n").unwrap();
        let expected = [([1.0, 2.5], "kitchen"), ([-3.0, 0.0], "lab, upper")];
        assert_eq!(read.len(), 2);
        for (read, (point, name)) in read.iter().zip(expected) {
            assert_eq!((read.point, read.name.as_str()), (point, name));
        }
    }

    #[test]
    fn what_is_wrong_is_said_with_its_line() {
        let refusal = |text: &str| PointName::read_all(text).unwrap_err().to_string();
        assert!(refusal("1,2,a\n1,b").starts_with("line 2: it does not begin with two numbers"));
        assert!(refusal("1,2").starts_with("line 1: the name is missing"));
        assert!(refusal("nan,2,a").starts_with("line 1: it does not begin"));
    }
}
