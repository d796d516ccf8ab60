//! Names of joints, kept in the browser by the hierarchy that they belong to, for all viewers of the site. When the browser keeps nothing or
//! is full, nobody is told: the names last until the page is closed.

use web_sys::Storage;

use crate::model::SavedNames;
use crate::session::{NameCommand, Session};

/// More text than this is not kept, in bytes: names for two thousand joints.
const MOST_BYTES: usize = 64 * 1024;

/// Which names were read from the browser's store, and which were put there.
#[derive(Debug, Default)]
pub(super) struct JointNames {
    model: u64,
    revision: u64,
}

impl JointNames {
    /// Gives a newly opened model the names that were kept for its hierarchy, and keeps names that the person gives. Returns whether the
    /// model got names.
    pub(super) fn follow(&mut self, session: &mut Session) -> bool {
        let opened = self.model != session.model_revision();
        self.model = session.model_revision();
        let restored = opened && restore(session).is_some();
        let revision = session.joint_names_revision();
        if !opened && self.revision != revision {
            // A failure is ignored; see above.
            let _ = keep(session);
        }
        self.revision = revision;
        restored
    }
}

fn store() -> Option<Storage> {
    web_sys::window()?.local_storage().ok()?
}

fn key(fingerprint: u64) -> String {
    format!("bindpose.names.{fingerprint:016x}")
}

fn restore(session: &mut Session) -> Option<()> {
    let fingerprint = session.saved_joint_names()?.fingerprint;
    if !session.joint_names().is_empty() {
        // They came along from a model with these bones.
        return None;
    }
    let text = store()?.get_item(&key(fingerprint)).ok()??;
    let kept = SavedNames::from_text(fingerprint, &text);
    session.apply(NameCommand::Import(kept));
    Some(())
}

fn keep(session: &Session) -> Option<()> {
    let saved = session.saved_joint_names()?;
    let (store, key) = (store()?, key(saved.fingerprint));
    let text = saved.to_text();
    if text.is_empty() {
        store.remove_item(&key).ok()
    } else if text.len() <= MOST_BYTES {
        store.set_item(&key, &text).ok()
    } else {
        None
    }
}
