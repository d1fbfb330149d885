//! What tells a map from the first of the ranking, and how to find out which is right.

use serde::{Deserialize, Serialize};

use super::place::EndReference;

/// What tells a map from the first.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize)]
pub struct MapDifference {
    /// In words.
    pub sentence: String,
    /// The first visit on which the two disagree.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub parting: Option<PartingVisit>,
    /// Travels that find out which is right; absent if none through known links do.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub test: Option<TestTravels>,
}

/// A visit that two maps take for different ones.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
pub struct PartingVisit {
    /// The visit, the start being 0.
    pub visit: u64,
    /// Its place in the first map.
    pub first_place: u32,
    /// φ in the first map.
    pub first_rotation: u32,
    /// Its place in this one.
    pub place: u32,
    /// φ in this one.
    pub rotation: u32,
}

/// Travels from where the robot is, the last of which the two maps say different things about.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize)]
pub struct TestTravels {
    /// The gateways to leave by, one after the other, as gateways of the first map.
    pub exits: Vec<EndReference>,
    /// The end that the last travel arrives by, says the first map; absent if anything may follow.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub first_arrival: Option<EndReference>,
    /// The same as this map says it, in this map.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub arrival: Option<EndReference>,
}

/// What a map predicts of the last travel of a test: the end arrived by, and the star seen there.
pub(crate) type Predicted = Option<(EndReference, String)>;

impl MapDifference {
    /// The difference in words; of the test the exits, and what either map predicts.
    pub(crate) fn sentence(
        parting: &PartingVisit,
        test: Option<(&[EndReference], &[Predicted; 2])>,
    ) -> String {
        let PartingVisit { visit, first_place, place, .. } = parting;
        let parted = if first_place == place {
            format!("visit {visit} sees place {place} from another side.")
        } else {
            format!("visit {visit} is at place {first_place} in map 1, at place {place} here.")
        };
        let Some((exits, predictions)) = test else {
            return parted + " No travel through known links tells them apart.";
        };
        let leave = |exit: &EndReference| format!("leave place {} by {}", exit.place, exit.end);
        let way: Vec<String> = exits.iter().map(leave).collect();
        let [first, here] = predictions.each_ref().map(says);
        format!("{parted} To find out: {}. Map 1 says: {first}; this one: {here}.", way.join(", "))
    }
}

fn says(predicted: &Predicted) -> String {
    match predicted {
        None => "anything may follow".to_owned(),
        Some((end, star)) => format!("place {}, entered by {} of the star {star}", end.place, end.end),
    }
}
