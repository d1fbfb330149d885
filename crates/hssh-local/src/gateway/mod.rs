//! Gateways: where the ways out of a place narrow (section 2.2.2, third definition), and where there is a door
//! (second definition).

mod line;
mod parameters;
mod search;
mod visibility;

pub use line::Gateway;
pub(crate) use line::gateway_at;
pub use parameters::GatewayParameters;
pub(crate) use search::{constrictions, gateway_on};
pub use visibility::{DoorParameters, doors, hidden_area};
