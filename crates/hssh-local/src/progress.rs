//! What those who wait for long work answer when they are told how far it is.

/// Whether to go on. Work that is stopped makes of what it has what it can.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Reply {
    /// Go on.
    #[default]
    GoOn,
    /// Stop soon.
    Stop,
}

/// Who says nothing wants it to go on.
impl From<()> for Reply {
    fn from((): ()) -> Self {
        Reply::GoOn
    }
}
