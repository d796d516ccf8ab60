//! The whole window.
