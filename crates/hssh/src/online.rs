//! Mapping on-line: one travel at a time, with an answer whenever one is asked for.

use std::sync::Arc;

use hssh_causal::{Exploration, ExplorationError, NamedStar, Odometry, StarType, Travel};
use hssh_search::{Mapper, StopReason, Visit, VisitError};
use hssh_topology::Olp;

use crate::answer::Answer;
use crate::pipeline::{
    Input, MappingOptions, Means, Monitor, PipelineError, SearchFailure, SearchLimits, SearchMethod,
    Searched, Task, answered,
};

/// A robot's exploration while it goes on, and the search for its maps.
///
/// ```
/// use hssh::causal::NamedStar;
/// use hssh::online::OnlineMapping;
/// use hssh::pipeline::MappingOptions;
/// use hssh::topology::Olp;
///
/// let star = |name: &str, ends: &str| NamedStar {
///     name: name.into(),
///     star: ends.parse().unwrap(),
///     bearings: vec![None; ends.split(' ').count()],
/// };
/// let start = star("west", "0+ (0-)");
/// let mut mapping = OnlineMapping::start("corridor", start, MappingOptions::default(), Default::default())?;
/// mapping.observe(Olp::new(0), Olp::new(1), star("east", "(0+) 0-"), None)?;
/// mapping.advance();
/// assert_eq!(mapping.answer().maps[0].places.len(), 2);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct OnlineMapping {
    input: Input,
    options: MappingOptions,
    method: SearchMethod,
    monitor: Arc<Monitor>,
    /// Nothing only while an answer is put together.
    mapper: Option<Box<Mapper>>,
}

/// Why there is no mapping on-line, or a visit is none.
#[derive(Debug, thiserror::Error)]
pub enum OnlineError {
    /// Options make no sense.
    #[error(transparent)]
    Options(#[from] PipelineError),
    /// A visit that cannot have happened.
    #[error(transparent)]
    Exploration(#[from] ExplorationError),
    /// A visit that the search cannot use.
    #[error(transparent)]
    Visit(#[from] VisitError),
    /// Hypotheses are counted from beginning to end.
    #[error(
        "hypotheses are counted for a whole exploration: search in another way to go on travel by travel"
    )]
    Counted,
    /// Errors of perception are reckoned with in whole explorations.
    #[error("errors of perception are reckoned with in whole explorations, not travel by travel")]
    Readings,
}

impl OnlineMapping {
    /// A robot that sees its first star. The monitor shows other threads how far a search is, and lets them stop it.
    ///
    /// How to search, if it is not said, is decided by the first travel: by posterior if it is measured, then all have to be.
    ///
    /// # Errors
    /// If options make no sense or contradict one another, or the star is none.
    pub fn start(
        name: impl Into<String>,
        star: NamedStar,
        options: MappingOptions,
        monitor: Arc<Monitor>,
    ) -> Result<Self, OnlineError> {
        options.check()?;
        if options.readings.model.is_some() {
            return Err(OnlineError::Readings);
        }
        let exploration = Exploration::new(vec![star], StarType(0), Vec::new())?;
        let method = options.method_for(&exploration)?;
        if method == SearchMethod::Count {
            return Err(OnlineError::Counted);
        }
        let mapper = begun(&exploration, &options, method, &monitor)?;
        let input = Input::exploration(name, exploration);
        Ok(OnlineMapping { input, options, method, monitor, mapper: Some(mapper) })
    }

    /// One travel more: by which end the robot left the star seen last, by which it came in, what it sees now, and the frame of this
    /// visit in that of the one before. The maps follow with [`advance`](Self::advance).
    ///
    /// # Errors
    /// If it cannot have happened, or if the search asks for a measurement that is not there. Everything is as it was then.
    pub fn observe(
        &mut self,
        exit: Olp,
        entry: Olp,
        star: NamedStar,
        odometry: Option<Odometry>,
    ) -> Result<(), OnlineError> {
        let before = &self.input.exploration;
        let mut star_types = before.star_types().to_vec();
        // Stars are told apart as the mapper does.
        let same = |other: &NamedStar| (&other.star, &other.bearings) == (&star.star, &star.bearings);
        let known = star_types.iter().position(same);
        let index = known.unwrap_or_else(|| {
            star_types.push(star);
            star_types.len() - 1
        });
        let travel = Travel { exit, entry, star: StarType(index as u32), odometry };
        let travels = before.travels().iter().cloned().chain([travel]).collect();
        let exploration = Exploration::new(star_types, before.start(), travels)?;
        let last = exploration.travels().len() - 1;
        if last == 0 {
            self.method = self.options.method_for(&exploration)?;
            self.mapper = Some(begun(&exploration, &self.options, self.method, &self.monitor)?);
        }
        self.mapper_mut().observe(Visit::of(&exploration, last))?;
        self.input.exploration = exploration;
        Ok(())
    }

    /// Searches on until everything observed is explained as well as was asked for, or a limit stops it.
    pub fn advance(&mut self) -> StopReason {
        self.mapper_mut().advance()
    }

    /// Sets other limits for the next [`advance`](Self::advance).
    pub fn set_limits(&mut self, limits: SearchLimits) {
        self.options.limits = limits;
        self.mapper_mut().set_limits(limits.of_search());
    }

    /// What was observed.
    #[must_use]
    pub fn exploration(&self) -> &Exploration {
        &self.input.exploration
    }

    /// What is known of the travels observed, as far as they were searched.
    pub fn answer(&mut self) -> Answer {
        let mapper = self.mapper.take().expect("a mapper that is not put together into an answer");
        let searched = Searched::of(mapper, self.method, &self.options);
        let exploration = self.input.exploration.clone();
        let mapped = answered(&self.input, &exploration, &self.options, searched, Vec::new());
        let (answer, mapper) = mapped.into_answer_and_mapper();
        self.mapper = mapper;
        answer
    }

    fn mapper_mut(&mut self) -> &mut Mapper {
        self.mapper.as_mut().expect("a mapper that is not put together into an answer")
    }
}

/// A mapper at the start of an exploration of which no travel was told yet; what there is of it says how to search.
fn begun(
    exploration: &Exploration,
    options: &MappingOptions,
    method: SearchMethod,
    monitor: &Arc<Monitor>,
) -> Result<Box<Mapper>, PipelineError> {
    let task = Task {
        exploration,
        options,
        method,
        likeness: None,
        monitor,
        is_online: true,
        means: &Means::default(),
    };
    let start = &exploration.star_types()[exploration.start().index()];
    let mapper = task.mapper_builder()?.start_with(&start.star, &start.bearings);
    Ok(Box::new(mapper.map_err(SearchFailure::from)?))
}
