//! What those who look on are shown: the last map, and where the robot is now.

use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use hssh_local::Track;
use hssh_metrics::Pose;

/// The newest of everything; who is slow misses what came between.
#[derive(Default)]
pub(crate) struct Hub {
    state: Mutex<State>,
    changed: Condvar,
}

#[derive(Default)]
struct State {
    page: Shown,
    robot: Shown,
    /// A scan, and where the last map has the robot at it.
    anchor: Option<(usize, Pose)>,
    has_ended: bool,
}

/// A text, and how often it has changed.
#[derive(Clone, Default)]
pub(crate) struct Shown {
    pub(crate) text: Arc<str>,
    pub(crate) version: u64,
}

/// What somebody who looks on has not seen yet.
pub(crate) struct News {
    pub(crate) page: Option<Shown>,
    pub(crate) robot: Option<Shown>,
    pub(crate) has_ended: bool,
}

impl Hub {
    fn lock(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Shows a map, in which the robot was at a pose when it took a scan.
    pub(crate) fn show_page(&self, data: String, anchor: Option<(usize, Pose)>) {
        let mut state = self.lock();
        state.page = Shown { text: data.into(), version: state.page.version + 1 };
        state.anchor = anchor.or(state.anchor);
        self.changed.notify_all();
    }

    /// Shows where the robot is.
    pub(crate) fn show_robot(&self, data: String) {
        let mut state = self.lock();
        state.robot = Shown { text: data.into(), version: state.robot.version + 1 };
        self.changed.notify_all();
    }

    /// Where the last scan of a track was taken in the frame of the last map; without one, in that of the first scan.
    pub(crate) fn place(&self, track: &Track) -> Option<Pose> {
        let now = track.scans.last()?.pose;
        let anchored = self.lock().anchor.and_then(|(scan, pose)| Some((track.scans.get(scan)?.pose, pose)));
        Some(anchored.map_or(now, |(then, pose)| pose.compose(then.between(now))))
    }

    /// Nothing more will be shown.
    pub(crate) fn end(&self) {
        self.lock().has_ended = true;
        self.changed.notify_all();
    }

    /// The last map.
    pub(crate) fn page(&self) -> Shown {
        self.lock().page.clone()
    }

    /// Waits a while for something newer than these versions of the map and of the robot.
    pub(crate) fn news(&self, [page, robot]: [u64; 2], patience: Duration) -> News {
        let is_old = |state: &mut State| {
            state.page.version <= page && state.robot.version <= robot && !state.has_ended
        };
        let waited = self.changed.wait_timeout_while(self.lock(), patience, is_old);
        let (state, _) = waited.unwrap_or_else(PoisonError::into_inner);
        News {
            page: (state.page.version > page).then(|| state.page.clone()),
            robot: (state.robot.version > robot).then(|| state.robot.clone()),
            has_ended: state.has_ended,
        }
    }
}
