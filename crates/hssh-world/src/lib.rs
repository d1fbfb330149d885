//! Simulated worlds and routes through them; knows nothing of the mapper.
