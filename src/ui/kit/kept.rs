//! What takes long to work out, kept for as long as what it follows from stays the same.

/// The value of the last key.
#[derive(Debug)]
pub(crate) struct Kept<K, V>(Option<(K, V)>);

impl<K, V> Default for Kept<K, V> {
    fn default() -> Self {
        Self(None)
    }
}

impl<K: PartialEq, V> Kept<K, V> {
    /// The value of a key. It is worked out only where the key was another one before.
    pub(crate) fn of(&mut self, key: K, work_out: impl FnOnce() -> V) -> &V {
        self.0.take_if(|(of, _)| *of != key);
        &self.0.get_or_insert_with(|| (key, work_out())).1
    }
}
