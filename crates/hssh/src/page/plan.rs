//! The page of a grid map: its regions, passages, places and connections over the grid.

use hssh_local::OccupancyGrid;
use serde::{Deserialize, Serialize};

use super::data::PageImage;
use super::html;
use crate::account::PlacesAccount;

/// All that the page of a grid map shows.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct PlanData {
    /// [`PlanData::FORMAT`].
    pub format: String,
    /// [`PlanData::VERSION`].
    pub version: u32,
    /// What was found, as `hssh stars --json` prints it.
    pub account: PlacesAccount,
    /// The grid in its own frame, as far as anything is known of it.
    pub grid: PageImage,
}

impl PlanData {
    /// What the data of such pages call their format.
    pub const FORMAT: &str = "hssh-plan";
    /// The version of the data that this library writes.
    pub const VERSION: u32 = 1;

    /// What the page of a grid map shows.
    #[must_use]
    pub fn new(account: &PlacesAccount, grid: &OccupancyGrid) -> Self {
        PlanData {
            format: Self::FORMAT.to_owned(),
            version: Self::VERSION,
            account: account.clone(),
            grid: PageImage::of(grid),
        }
    }

    /// The page. Equal data give equal pages.
    #[must_use]
    pub fn to_html(&self) -> String {
        let json = serde_json::to_string(self).expect("a plan is structs, lists, texts and numbers");
        html::PLAN.filled(&json, false)
    }
}
