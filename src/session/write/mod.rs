//! What is open as a file: what is asked, what is lost, and the job that writes it.

pub(super) mod export;
pub(super) mod export_files;
pub(super) mod export_job;
pub(super) mod export_maps;
pub(super) mod export_plan;
pub(super) mod exporting;
mod picture_files;
