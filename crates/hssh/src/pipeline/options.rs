//! Every number and switch on the way from input to answer, by level, each with its default beside it.

use clap::ValueEnum;
use hssh_search::{ConstraintError, VisitConstraints};
use hssh_topology::{Axioms, Simplicity};
use ron::error::SpannedError;
use ron::extensions::Extensions;
use serde::{Deserialize, Serialize};

use super::error::PipelineError;
use super::laser::LaserChoice;
use super::places::PlaceChoice;
use super::reading::ReadingChoice;

/// How to come to an answer. Read from a RON file, whatever it leaves out has its default, and what it should not say is
/// refused with line and column:
///
/// ```
/// use hssh::pipeline::MappingOptions;
///
/// let options = MappingOptions::from_ron("(axioms: (max_genus: 0), limits: (seconds: 60))")?;
/// assert_eq!(options.axioms.max_genus, Some(0));
///
/// let error = MappingOptions::from_ron("(\n  axioms: (planar: true),\n)").unwrap_err();
/// assert_eq!((error.line(), error.column()), (2, 12));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct MappingOptions {
    /// How a log's laser looks and sits.
    pub laser: LaserChoice,
    /// What counts as a place, along logs.
    pub places: PlaceChoice,
    /// How the tree of hypotheses is searched.
    pub search: SearchChoice,
    /// What makes a map possible.
    pub axioms: Axioms,
    /// What makes a map probable.
    pub posterior: PosteriorChoice,
    /// Which visits are known to be to one place, and which are not.
    pub visits: VisitChoice,
    /// Whether perception may have erred.
    pub readings: ReadingChoice,
    /// When to stop.
    pub limits: SearchLimits,
    /// How many maps the answer lists; all if none is said.
    pub listed: Option<usize>,
}

impl Default for MappingOptions {
    fn default() -> Self {
        MappingOptions {
            laser: LaserChoice::default(),
            places: PlaceChoice::default(),
            search: SearchChoice::default(),
            axioms: Axioms::default(),
            posterior: PosteriorChoice::default(),
            visits: VisitChoice::default(),
            readings: ReadingChoice::default(),
            limits: SearchLimits::default(),
            listed: Some(10),
        }
    }
}

/// What somebody knows of visits, counted from 0, the start. Maps that say otherwise explain nothing.
#[derive(Clone, PartialEq, Eq, Debug, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct VisitChoice {
    /// Pairs of visits to the same place.
    pub same: Vec<[usize; 2]>,
    /// Pairs of visits to different places.
    pub different: Vec<[usize; 2]>,
}

impl VisitChoice {
    /// As the search takes them.
    ///
    /// # Errors
    /// If they contradict one another.
    pub fn constraints(&self) -> Result<VisitConstraints, ConstraintError> {
        VisitConstraints::new(&self.same, &self.different)
    }

    /// The same of other numbers: pairs with a visit that has none are left out.
    pub(super) fn renumbered(&self, number: impl Fn(usize) -> Option<usize>) -> Self {
        let renumber = |pairs: &[[usize; 2]]| -> Vec<[usize; 2]> {
            pairs.iter().filter_map(|&[one, other]| Some([number(one)?, number(other)?])).collect()
        };
        VisitChoice { same: renumber(&self.same), different: renumber(&self.different) }
    }
}

/// How the tree of hypotheses is searched.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize, ValueEnum)]
#[serde(rename_all = "snake_case")]
pub enum SearchMethod {
    /// All hypotheses, level by level.
    BreadthFirst,
    /// The best hypothesis by preference first: fast, may miss the optimum.
    BestFirst,
    /// The best hypothesis by preference of each number of travels explained in turn, until the best maps are proved.
    Cyclic,
    /// By a bound that proves the best maps, all of them.
    Proof,
    /// Count all hypotheses in constant memory; lists no maps.
    Count,
    /// The most probable maps given the measured travels, with a proof.
    Posterior,
    /// The most probable hypothesis first, as in the thesis: may miss the optimum.
    PosteriorBestFirst,
    /// All maps with their probabilities, level by level.
    PosteriorBreadthFirst,
    /// The most probable maps, by the least bound first, with a proof.
    PosteriorProof,
}

/// Where the genus stands in the order of preference.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize, ValueEnum)]
#[serde(rename_all = "snake_case")]
pub enum GenusOrder {
    /// Before everything else.
    First,
    /// After everything else.
    Last,
}

/// How to search.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct SearchChoice {
    /// The method; if none is said, posterior if every travel has odometry and `genus` is not set, else breadth-first.
    pub method: Option<SearchMethod>,
    /// Accept closed maps only, and go back until there is one. Not with breadth-first and count.
    pub closed: bool,
    /// Where the genus stands in the order of preference, if it counts.
    pub genus: Option<GenusOrder>,
    /// Threads, 0 for one per core; the result does not depend on them.
    pub threads: usize,
}

/// How well a map fits the measured travels.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Serialize, Deserialize, ValueEnum)]
#[serde(rename_all = "snake_case")]
pub enum MetricalScore {
    /// The density of the measurements whatever the layout, with a price for every new place.
    #[default]
    Evidence,
    /// Their density at the most likely layout, as in the thesis.
    Likelihood,
    /// They do not count.
    Ignored,
}

/// How probable a map is before anything is measured.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize, ValueEnum)]
#[serde(rename_all = "snake_case")]
pub enum PriorKind {
    /// All maps alike.
    Flat,
    /// In inverse proportion to F = c1·f1 + c2·f2' + c3·f3, as in the thesis.
    Simplicity,
    /// All extensions of a map alike, wherever there is a choice.
    Choices,
}

/// What makes a map probable.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct PosteriorChoice {
    /// How measurements count.
    pub score: MetricalScore,
    /// What counts besides; if nothing is said, flat with evidence, else simplicity.
    pub prior: Option<PriorKind>,
    /// The weights of F.
    pub weights: Simplicity,
    /// New places may be anywhere in that many square metres; without it, where corridors as long as those travelled
    /// lead.
    pub area: Option<f64>,
    /// How many of the best maps to prove.
    pub best: usize,
    /// Go on until all maps not found have at most that probability together; 1 to stop at the proof.
    pub rest: f64,
    /// Along logs: the weight of how alike local maps look. Neighboring cells are not independent, so that 1 is too much.
    pub likeness: f64,
}

impl Default for PosteriorChoice {
    fn default() -> Self {
        PosteriorChoice {
            score: MetricalScore::Evidence,
            prior: None,
            weights: Simplicity::default(),
            area: None,
            best: 1,
            rest: 0.01,
            likeness: 0.0,
        }
    }
}

/// When to stop before the end.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct SearchLimits {
    /// Explain only the first travels.
    pub travels: Option<usize>,
    /// Hypotheses.
    pub nodes: Option<u64>,
    /// Seconds of searching.
    pub seconds: Option<f64>,
    /// MiB of the whole process, if the [monitor](super::Monitor::watch_memory) knows, as that of the program does; else of the tree and of
    /// what waits to be searched.
    pub mebibytes: u64,
}

impl Default for SearchLimits {
    fn default() -> Self {
        SearchLimits { travels: None, nodes: None, seconds: None, mebibytes: 4096 }
    }
}

/// Why a text is no options.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[error("line {line}, column {column}: {problem}")]
pub struct OptionsError {
    line: usize,
    column: usize,
    problem: String,
}

impl OptionsError {
    /// Where it is wrong, the first line being 1.
    #[must_use]
    pub fn line(&self) -> usize {
        self.line
    }

    /// Where in the line, the first letter being 1.
    #[must_use]
    pub fn column(&self) -> usize {
        self.column
    }

    /// What is wrong.
    #[must_use]
    pub fn problem(&self) -> &str {
        &self.problem
    }
}

impl From<SpannedError> for OptionsError {
    fn from(error: SpannedError) -> Self {
        let start = error.span.start;
        OptionsError { line: start.line, column: start.col, problem: error.code.to_string() }
    }
}

/// What a finite number among the options may be.
enum MayBe {
    /// Zero, or anything above.
    Zero,
    /// Anything above zero.
    Positive,
    /// From one degree to a full turn.
    View,
}

impl MappingOptions {
    /// The defaults as a file, with what each means.
    pub const DEFAULTS: &str = include_str!("defaults.ron");

    /// Reads options.
    ///
    /// # Errors
    /// If the text is no RON, says something unknown, or says it wrongly.
    pub fn from_ron(text: &str) -> Result<Self, OptionsError> {
        let reader = ron::Options::default().with_default_extension(Extensions::IMPLICIT_SOME);
        Ok(reader.from_str(text)?)
    }

    /// Refuses numbers that make no sense, and axioms that do not go together. Whatever is made with options checks them.
    ///
    /// # Errors
    /// With the first such number, or if it is the axioms.
    pub fn check(&self) -> Result<(), PipelineError> {
        let MappingOptions { axioms, laser, places, posterior, limits, .. } = self;
        axioms.check()?;
        self.readings.model.map_or(Ok(()), |model| model.check())?;
        let (x, y, turn) = laser.pose.unwrap_or_default();
        let numbers = [
            ("places.narrowest", places.narrowest, MayBe::Zero),
            ("places.shallowest", places.shallowest, MayBe::Zero),
            ("places.clutter", places.clutter, MayBe::Zero),
            ("laser.view", laser.view, MayBe::View),
            ("laser.pose", Some(x.abs().max(y.abs()).max(turn.abs())), MayBe::Zero),
            ("posterior.likeness", Some(posterior.likeness), MayBe::Zero),
            ("posterior.area", posterior.area, MayBe::Positive),
            ("posterior.rest", Some(posterior.rest), MayBe::Positive),
            ("limits.seconds", limits.seconds, MayBe::Zero),
        ];
        for (name, number, may_be) in numbers {
            let Some(number) = number else { continue };
            let (is_right, what) = match may_be {
                MayBe::Zero => (number >= 0.0, "finite and not negative"),
                MayBe::View => ((1.0..=360.0).contains(&number), "an angle between 1 and 360 degrees"),
                MayBe::Positive => (number > 0.0, "finite and positive"),
            };
            if !is_right || !number.is_finite() {
                return Err(PipelineError::Number { name, number, what });
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is printed is what holds, and nothing is left out.
    #[test]
    fn the_file_of_defaults_says_every_default() {
        let reader = ron::Options::default().with_default_extension(Extensions::IMPLICIT_SOME);
        let written: MappingOptions = reader.from_str(MappingOptions::DEFAULTS).unwrap();
        assert_eq!(written, MappingOptions::default());
        let all = serde_json::to_value(MappingOptions::default()).unwrap();
        for name in names(&all) {
            assert!(MappingOptions::DEFAULTS.contains(&format!("{name}: ")), "{name}");
        }
    }

    #[test]
    fn numbers_that_make_no_sense_are_refused() {
        for (text, name) in [
            ("(places: (clutter: -1))", "places.clutter"),
            ("(limits: (seconds: NaN))", "limits.seconds"),
            ("(posterior: (rest: 0))", "posterior.rest"),
            ("(posterior: (area: inf))", "posterior.area"),
        ] {
            let error = MappingOptions::from_ron(text).unwrap().check().unwrap_err().to_string();
            assert!(error.starts_with(&format!("the option {name} is ")), "{error}");
        }
    }

    #[test]
    fn perpendicular_maps_with_paths_that_cross_themselves_are_refused() {
        let check = |text: &str| MappingOptions::from_ron(text).unwrap().check();
        assert!(check("(axioms: (perpendicular: true))").is_ok());
        let error = check("(axioms: (perpendicular: true, no_self_intersection: false))").unwrap_err();
        assert!(error.to_string().contains("leave out perpendicularity"), "{error}");
    }

    fn names(value: &serde_json::Value) -> Vec<String> {
        let serde_json::Value::Object(fields) = value else { return Vec::new() };
        fields.iter().flat_map(|(name, value)| std::iter::once(name.clone()).chain(names(value))).collect()
    }

    #[test]
    fn what_is_wrong_is_said_with_its_place() {
        let cases = [
            ("(search: (method: depth_first))", (1, 19), "depth_first"),
            ("(\n    limits: (\n        seconds: \"soon\",\n    ),\n)", (3, 17), "float"),
            ("(axioms: (planar: true))", (1, 11), "planar"),
            ("(posterior: (best: -1))", (1, 21), "bounds"),
            ("(axioms: ", (1, 9), "struct"),
        ];
        for (text, place, word) in cases {
            let error = MappingOptions::from_ron(text).unwrap_err();
            assert!(error.to_string().contains(word), "{text}: {error}");
            assert_eq!((error.line(), error.column()), place, "{text}: {error}");
        }
    }
}
