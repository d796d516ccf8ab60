//! The interface, used as a person uses it: by the names of its controls, by keys, pointer and fingers; and looked at.

mod access;
mod announce;
mod app;
mod browser_golden;
mod camera_motion;
#[path = "../core/chains.rs"]
#[allow(dead_code, reason = "shared with the tests of the core, which need more of it")]
mod chains;
mod chips;
mod crowd;
#[path = "../core/documents.rs"]
#[allow(dead_code, reason = "shared with the tests of the core, which need more of it")]
mod documents;
mod dope_sheet;
mod drawer;
mod export;
mod file_menu;
mod findings;
mod first_minute;
mod focus;
mod idle;
mod joint_numbers;
mod joint_tree;
mod keys;
mod layout;
mod look;
mod messages;
mod mirror;
#[path = "../core/session/models.rs"]
#[allow(dead_code, reason = "shared with the tests of the session, which need more of it")]
mod models;
mod page;
mod panels;
mod parts;
mod picture;
mod pointer;
mod popovers;
mod refused;
mod rigs;
mod roles;
mod saving;
#[path = "../common/shared.rs"]
mod shared;
mod skeleton;
mod split;
mod submeshes;
mod timeline;
mod undo;
