//! Gateways: where the ways out of a place narrow (section 2.2.2, third definition).

mod line;
mod parameters;
mod search;

pub use line::Gateway;
pub(crate) use line::gateway_at;
pub use parameters::GatewayParameters;
pub(crate) use search::{constrictions, gateway_on};
