//! Names of joints, kept in the browser by the hierarchy that they belong to, for all viewers of the site. When the browser keeps nothing or
//! is full, nobody is told: the names last until the page is closed. Those of the hierarchies that were named longest ago give way to others.

use web_sys::Storage;

use crate::model::SavedNames;
use crate::session::{NameCommand, Session};
use crate::sorting;

/// More text than this is not kept, in bytes: names for two thousand joints.
const MOST_BYTES: usize = 64 * 1024;
/// Names of more hierarchies than this are not kept.
const MOST_KEPT: usize = 64;

/// Before the fingerprint of a hierarchy, in the keys of the store.
const PREFIX: &str = "bindpose.names.";
/// The keys in the order in which their names were given, the last one at the end.
const ORDER: &str = "bindpose.names";

/// Which names were read from the browser's store, and which were put there.
#[derive(Debug, Default)]
pub(super) struct JointNames {
    model: u64,
    revision: u64,
}

impl JointNames {
    /// Gives a newly opened model the names that were kept for its hierarchy, and keeps names that the person gives. Names that were
    /// `changed_elsewhere` replace those of the model. Returns whether the model got names.
    pub(super) fn follow(&mut self, session: &mut Session, changed_elsewhere: bool) -> bool {
        let opened = self.model != session.model_revision();
        self.model = session.model_revision();
        // What came along from a model with these bones stays.
        let reads = changed_elsewhere || opened && session.joint_names().is_empty();
        let restored = reads && restore(session).is_some();
        let revision = session.joint_names_revision();
        if !reads && !opened && self.revision != revision {
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
    format!("{PREFIX}{fingerprint:016x}")
}

fn restore(session: &mut Session) -> Option<()> {
    let fingerprint = session.saved_joint_names()?.fingerprint;
    let text = store()?.get_item(&key(fingerprint)).ok()??;
    let kept = SavedNames::from_text(fingerprint, &text);
    session.apply(NameCommand::Import(kept));
    Some(())
}

fn keep(session: &Session) -> Option<()> {
    let saved = session.saved_joint_names()?;
    let (store, key) = (store()?, key(saved.fingerprint));
    let text = saved.to_text();
    // Where there is no room for all of them, fewer are not taken for all.
    store.remove_item(&key).ok()?;
    if !text.is_empty() && text.len() <= MOST_BYTES {
        make_room(&store, &key)?;
        store.set_item(&key, &text).ok()?;
    }
    Some(())
}

/// Notes that names are given for a key, and forgets those of the keys for which that is longest ago.
fn make_room(store: &Storage, key: &str) -> Option<()> {
    let order = store.get_item(ORDER).ok()?.unwrap_or_default();
    let all = (0..store.length().ok()?).filter_map(|index| store.key(index).ok()?);
    let mut kept: Vec<String> = all.filter(|kept| kept.starts_with(PREFIX) && kept != key).collect();
    // Those that are not in the order come first.
    sorting::sort_by_key(&mut kept, |kept| {
        order
            .split(' ')
            .position(|known| known == kept)
            .map_or(0, |place| place + 1)
    });
    let too_many = (kept.len() + 1).saturating_sub(MOST_KEPT);
    for old in kept.drain(..too_many) {
        store.remove_item(&old).ok()?;
    }
    kept.push(key.to_owned());
    store.set_item(ORDER, &kept.join(" ")).ok()
}
