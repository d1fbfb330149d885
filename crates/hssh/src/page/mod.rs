//! A page: one self-contained HTML file that shows an answer or a grid map, to look at and to click through without a network.

mod data;
mod drawing;
mod error;
mod history;
mod html;
mod image;
mod plan;
mod seen;
mod tree;
mod way;

pub use data::{
    PageBelief, PageData, PageEnd, PageFate, PageHistory, PageImage, PageMap, PageNode, PagePlace, PageStar,
    PageTree, PageVisit,
};
pub use error::PageError;
pub use plan::PlanData;

use std::sync::Arc;

use crate::answer::{AnsweredMap, StopReason};
use crate::pipeline::{Input, Mapped, MappingOptions, Monitor, SurveyedLog, map};
use way::Thinned;

/// The on-line search of a page makes no more hypotheses than so many, and so many times those of the search itself.
const MOST_HYPOTHESES: (u64, u64) = (100_000, 4);

/// Grids of the building are drawn for the first maps of the ranking, no more than so many.
const MOST_GRIDS: usize = 4;

impl PageData {
    /// What the page of an answer shows, which opens with the map of the rank `shown`. What was believed on the way is searched for here, which
    /// takes about as long as the search itself; `monitor` may stop it.
    ///
    /// # Errors
    /// If the on-line search cannot begin, or a map cannot be drawn.
    pub fn new(
        input: &Input,
        mapped: &Mapped,
        options: &MappingOptions,
        shown: u64,
        monitor: &Arc<Monitor>,
    ) -> Result<Self, PageError> {
        let (least, times) = MOST_HYPOTHESES;
        let most = mapped.answer.search.nodes.saturating_mul(times).saturating_add(least);
        let told = mapped.history(input, options, most, monitor)?;
        let mut page = Self::without_history(input, mapped, shown)?;
        page.history = history::page_history(&told);
        if let (None, Some(travels)) = (page.maps.first(), told.beliefs.len().checked_sub(1)) {
            page.reference = best_of_first(input, mapped, options, travels)?;
        }
        Ok(page)
    }

    /// The same at once, without what was believed on the way.
    ///
    /// # Errors
    /// If a map cannot be drawn.
    pub fn without_history(input: &Input, mapped: &Mapped, shown: u64) -> Result<Self, PageError> {
        let answer = &mapped.answer;
        let surveyed = input.as_surveyed();
        let thinned = surveyed.map(|surveyed| Thinned::of(&surveyed.survey));
        let visits = seen::visits(input, mapped, thinned.as_ref());
        let mut maps = answer.maps.iter().map(drawing::page_map).collect::<Result<Vec<_>, _>>()?;
        let grids = thinned.map_or_else(Vec::new, |thinned| grids(input, mapped, &thinned, &mut maps));
        Ok(PageData {
            format: Self::FORMAT.to_owned(),
            version: Self::VERSION,
            live: None,
            waiting: None,
            input: answer.input.clone(),
            partial: surveyed.and_then(SurveyedLog::partial),
            doubt: answer.doubt(),
            verdict: answer.verdict.clone(),
            certificate: answer.certificate.clone(),
            search: answer.search.clone(),
            readings: answer.readings.clone(),
            warnings: answer.warnings.clone(),
            stars: seen::stars(mapped.exploration(input)),
            visits,
            shown: maps.iter().find(|map| map.rank == shown).map_or(1, |map| map.rank),
            maps,
            reference: None,
            grids,
            history: PageHistory::default(),
            tree: mapped.hypotheses().map(|tree| tree::page_tree(tree, answer)),
        })
    }

    /// The page of something that was not mapped yet, and where its news will come from.
    #[must_use]
    pub fn waiting(name: &str, live: &str, reason: &str) -> Self {
        let one_place = "(stars: {\"\": [\"0+\", \"0-\"]}, start: \"\", travels: [])";
        let input = Input::from_ron(name, one_place).expect("one place is an exploration");
        let mapped = map(&input, &MappingOptions::default(), &Arc::default()).expect("one place has a map");
        let mut page = Self::without_history(&input, &mapped, 1).expect("one place can be drawn");
        page.live = Some(live.to_owned());
        page.waiting = Some(reason.to_owned());
        (page.stars, page.visits, page.maps) = Default::default();
        page
    }

    /// The data as JSON.
    #[must_use]
    pub fn to_json(&self) -> String {
        serde_json::to_string(self).expect("a page is structs, lists, texts and numbers")
    }

    /// The page. Equal data give equal pages.
    #[must_use]
    pub fn to_html(&self) -> String {
        html::ANSWER.filled(&self.to_json(), self.live.is_some())
    }
}

/// The grids of the building that the first maps have, and the robot's ways; maps that place all scans alike share one grid. A map
/// whose grid would be too large has none.
fn grids(input: &Input, mapped: &Mapped, thinned: &Thinned, maps: &mut [PageMap]) -> Vec<PageImage> {
    let mut grids = Vec::new();
    let mut drawn = Vec::new();
    for (index, map) in maps.iter_mut().enumerate() {
        let Some(poses) = mapped.scan_poses(input, index + 1) else { continue };
        map.way = thinned.way(&poses);
        map.grid = drawn.iter().position(|other| *other == poses).map(|grid| grid as u32);
        if map.grid.is_none() && grids.len() < MOST_GRIDS {
            let Ok(building) = mapped.building(input, index + 1) else { continue };
            map.grid = Some(grids.len() as u32);
            grids.push(PageImage::of(&building));
            drawn.push(poses);
        }
    }
    grids
}

/// The best map of the first travels, closed or not; there is none if the search for it is stopped.
fn best_of_first(
    input: &Input,
    mapped: &Mapped,
    options: &MappingOptions,
    travels: usize,
) -> Result<Option<PageMap>, PageError> {
    let mut options = options.clone();
    options.search.closed = false;
    options.limits.travels = Some(travels);
    options.listed = Some(1);
    if mapped.answer.search.stop == StopReason::Interrupted || mapped.answer.readings.is_some() {
        return Ok(None);
    }
    let first = map(input, &options, &Arc::default())?.answer.maps.into_iter().next();
    Ok(first.as_ref().map(|map: &AnsweredMap| drawing::page_map(map)).transpose()?)
}
