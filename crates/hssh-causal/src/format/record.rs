//! Records: values with named fields, checked against the fields that there are.

use super::error::{Fault, Faults, Span};
use super::suggest::{did_you_mean, listed, nearest};
use super::tree::{Shape, Value};

/// What a record of one kind consists of.
pub(super) struct Schema {
    /// With its article, for error messages.
    pub(super) what: &'static str,
    /// What may be written before the bracket.
    pub(super) name: &'static str,
    pub(super) required: &'static [&'static str],
    pub(super) optional: &'static [&'static str],
    /// How one is written.
    pub(super) example: &'static str,
}

impl Schema {
    fn fields(&self) -> impl Iterator<Item = &'static str> + Clone {
        self.required.iter().chain(self.optional).copied()
    }
}

/// The fields of a record whose names are right.
pub(super) struct Record<'v, 'a> {
    fields: Vec<(&'a str, &'v Value<'a>)>,
}

impl<'v, 'a> Record<'v, 'a> {
    /// Reads a record, noting fields that are missing, unknown or written twice.
    pub(super) fn read(value: &'v Value<'a>, schema: &Schema, faults: &mut Faults) -> Option<Self> {
        let Shape::Record { name, fields: written } = &value.shape else {
            faults.add(no_record(value, schema));
            return None;
        };
        if let Some(name) = name.filter(|&name| name != schema.name) {
            faults.add(wrong_name(value.head(), name, schema));
            return None;
        }
        let mut record = Record { fields: Vec::new() };
        let mut misspelled = Vec::new();
        for (span, name, field) in written {
            if !schema.fields().any(|known| known == *name) {
                misspelled.extend(nearest(name, schema.fields()));
                faults.add(unknown_field(*span, name, schema));
            } else if record.get(name).is_some() {
                faults.add(Fault::new(
                    *span,
                    format!("the field `{name}` is written twice"),
                    "keep one of the two",
                ));
            } else {
                record.fields.push((name, field));
            }
        }
        for &missing in schema.required {
            if record.get(missing).is_none() && !misspelled.contains(&missing) {
                faults.add(missing_field(value.head(), missing, schema));
            }
        }
        Some(record)
    }

    pub(super) fn get(&self, name: &str) -> Option<&'v Value<'a>> {
        self.fields.iter().find(|(known, _)| *known == name).map(|&(_, value)| value)
    }
}

fn no_record(value: &Value<'_>, schema: &Schema) -> Fault {
    let help = match &value.shape {
        Shape::Tuple { name: Some("Some") } => "write the record itself, without `Some`".to_owned(),
        Shape::Word("None") => "leave the field out if there is nothing to say".to_owned(),
        _ => format!("{} is written `{}`", schema.what, schema.example),
    };
    Fault::new(value.head(), format!("expected {}, found {}", schema.what, value.describe()), help)
}

fn wrong_name(span: Span, name: &str, schema: &Schema) -> Fault {
    Fault::new(
        span,
        format!("expected {}, found a record named `{name}`", schema.what),
        format!("write `{}(..)`, or the bracket without a name", schema.name),
    )
}

fn unknown_field(span: Span, name: &str, schema: &Schema) -> Fault {
    let guess = did_you_mean(name, schema.fields());
    Fault::new(
        span,
        format!("{} has no field `{name}`", schema.what),
        format!("{guess}its fields are {}", listed(schema.fields())),
    )
}

fn missing_field(span: Span, name: &str, schema: &Schema) -> Fault {
    Fault::new(
        span,
        format!("the field `{name}` is missing"),
        format!("{} is written `{}`", schema.what, schema.example),
    )
}
