//! What hypotheses by posterior carry along, as plain data: layouts, and the poses that these share, are written once.

use std::collections::HashMap;
use std::sync::Arc;

use hssh_metrics::Pose;
use hssh_topology::{Axioms, SimplicityFloor};
use serde::ser::SerializeTuple;
use serde::{Deserialize, Serialize, Serializer};

use crate::pack::Pack;
use crate::posterior::by_posterior::{Burden, ByPosterior, Nats, Placing};
use crate::posterior::cost::Cost;
use crate::posterior::layout::Layout;
use crate::posterior::poses::{Poses, SHARED};

/// The layouts of hypotheses, and the poses that they share.
pub(crate) struct Layouts<'a> {
    poses: Vec<&'a Arc<[Pose]>>,
    layouts: Vec<(Vec<u32>, &'a Layout)>,
    /// Numbers, by where something is in memory.
    number_of_poses: HashMap<*const Pose, u32>,
    number_of_layout: HashMap<*const Layout, u32>,
}

impl<'a> Layouts<'a> {
    /// Takes in a layout that was not seen before.
    fn add(&mut self, layout: &'a Arc<Layout>) {
        let next = self.layouts.len() as u32;
        if *self.number_of_layout.entry(Arc::as_ptr(layout)).or_insert(next) != next {
            return;
        }
        let mut shared = Vec::new();
        for poses in layout.poses.shared() {
            let next = self.poses.len() as u32;
            let number = *self.number_of_poses.entry(poses.as_ptr()).or_insert(next);
            if number == next {
                self.poses.push(poses);
            }
            shared.push(number);
        }
        self.layouts.push((shared, layout));
    }
}

/// All poses, then all layouts.
impl Serialize for Layouts<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        struct All<'a>(&'a [(Vec<u32>, &'a Layout)]);
        impl Serialize for All<'_> {
            fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                let layouts = self.0.iter();
                serializer
                    .collect_seq(layouts.map(|(shared, layout)| (shared, layout.poses.last(), layout.chi2)))
            }
        }
        let poses: Vec<&[Pose]> = self.poses.iter().map(|poses| &***poses).collect();
        let mut both = serializer.serialize_tuple(2)?;
        both.serialize_element(&poses)?;
        both.serialize_element(&All(&self.layouts))?;
        both.end()
    }
}

/// The same as it is read.
#[derive(Deserialize)]
#[serde(from = "(Vec<Vec<Pose>>, Vec<(Vec<u32>, Vec<Pose>, f64)>)")]
pub(crate) struct ReadLayouts(Vec<Option<Arc<Layout>>>);

impl From<(Vec<Vec<Pose>>, Vec<(Vec<u32>, Vec<Pose>, f64)>)> for ReadLayouts {
    fn from((poses, layouts): (Vec<Vec<Pose>>, Vec<(Vec<u32>, Vec<Pose>, f64)>)) -> Self {
        let poses: Vec<Arc<[Pose]>> = poses.into_iter().map(Arc::from).collect();
        let shared =
            |number: &u32| poses.get(*number as usize).filter(|poses| poses.len() == SHARED).cloned();
        let layout = |(numbers, last, chi2): (Vec<u32>, Vec<Pose>, f64)| {
            let shared: Option<Vec<Arc<[Pose]>>> = numbers.iter().map(shared).collect();
            Some(Arc::new(Layout { poses: Poses::of(shared?, last)?, chi2 }))
        };
        ReadLayouts(layouts.into_iter().map(layout).collect())
    }
}

/// What a hypothesis carries, its layout by number.
#[derive(Serialize, Deserialize)]
pub(crate) struct PackedBurden {
    cost: Cost,
    floor: Option<SimplicityFloor>,
    bound: Nats,
    log_branches: f64,
    layout: u32,
    placing: PackedPlacing,
}

#[derive(Serialize, Deserialize)]
enum PackedPlacing {
    Done,
    Grown,
    Strained(f64),
}

impl Placing {
    /// The layout that it refers to.
    fn layout(&self) -> &Arc<Layout> {
        match self {
            Placing::Done(layout) | Placing::Grown(layout) | Placing::Strained(layout, _) => layout,
        }
    }
}

impl Pack for ByPosterior {
    type Shared<'a> = Layouts<'a>;
    type Read = ReadLayouts;
    type Packed = PackedBurden;

    fn share<'a>(loads: impl Iterator<Item = &'a Burden>) -> Layouts<'a> {
        let mut layouts = Layouts {
            poses: Vec::new(),
            layouts: Vec::new(),
            number_of_poses: HashMap::new(),
            number_of_layout: HashMap::new(),
        };
        loads.for_each(|burden| layouts.add(burden.placing.layout()));
        layouts
    }

    fn pack(burden: &Burden, layouts: &Layouts<'_>) -> PackedBurden {
        let Burden { cost, floor, bound, log_branches, ref placing } = *burden;
        PackedBurden {
            cost,
            floor,
            bound,
            log_branches,
            layout: layouts.number_of_layout[&Arc::as_ptr(placing.layout())],
            placing: match placing {
                Placing::Done(_) => PackedPlacing::Done,
                Placing::Grown(_) => PackedPlacing::Grown,
                Placing::Strained(_, promised) => PackedPlacing::Strained(*promised),
            },
        }
    }

    fn unpack(packed: PackedBurden, read: &ReadLayouts, _: &Axioms) -> Option<Burden> {
        let PackedBurden { cost, floor, bound, log_branches, layout, placing } = packed;
        let layout = read.0.get(layout as usize)?.clone()?;
        let placing = match placing {
            PackedPlacing::Done => Placing::Done(layout),
            PackedPlacing::Grown => Placing::Grown(layout),
            PackedPlacing::Strained(promised) => Placing::Strained(layout, promised),
        };
        Some(Burden { cost, floor, bound, log_branches, placing })
    }
}
