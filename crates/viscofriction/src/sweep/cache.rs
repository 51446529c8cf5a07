//! Bodies and elastomers that points of a sweep share.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use crate::files::Files;
use crate::scene::{Indenter, MaterialTable, Scene, SceneError};
use crate::solve::{BodyOfScene, HalfSpace, Parts, body, half_space};

/// Largest number of bodies, and of elastomers, that are kept for other points. Chosen: a search among them takes
/// microseconds.
const MAX_ENTRIES: usize = 64;
/// Largest fraction of the memory limit that the kept bodies may occupy. Chosen: several maps fit, and most is left to the
/// points.
const BODY_MEMORY_FRACTION: f64 = 0.25;

/// The bodies and elastomers of the last points.
///
/// What a table describes does not depend on the point, so that a row is the same with and without the cache.
#[derive(Debug, Default)]
pub(super) struct PartsCache {
    /// Bodies by their table and the memory limit \[bytes], because a body may be refused by it.
    bodies: Cache<(Indenter, u64), BodyOfScene>,
    /// Elastomers by their table.
    half_spaces: Cache<MaterialTable, HalfSpace>,
}

impl PartsCache {
    /// Body and elastomer of a scene, built unless they are kept.
    pub(super) fn parts(&self, scene: &Scene, files: &Files<'_>) -> Result<Parts, SceneError> {
        let memory = files.memory();
        let key = (scene.indenter.clone(), memory);
        let build = || {
            let found = body(&scene.indenter, files)?;
            let size = found.body.memory() / BODY_MEMORY_FRACTION / memory as f64;
            Ok((found, size))
        };
        Ok(Parts {
            body: self.bodies.get(key, build)?,
            half_space: self.half_spaces.get(scene.material.clone(), || {
                Ok((half_space(&scene.material, files)?, 0.0))
            })?,
        })
    }
}

/// Values by their keys, in the order of their last use. The oldest are dropped when there are too many or they are too large;
/// one always remains.
#[derive(Debug)]
struct Cache<K, V>(Mutex<Vec<Entry<K, V>>>);

/// A value in the cache, shared with those who use it.
#[derive(Debug)]
struct Entry<K, V> {
    key: K,
    value: Arc<V>,
    /// Memory as a fraction of that of the cache.
    size: f64,
}

impl<K, V> Default for Cache<K, V> {
    fn default() -> Self {
        Self(Mutex::default())
    }
}

impl<K: PartialEq, V> Cache<K, V> {
    /// The value of a key; `build` returns the value and its size as a fraction of the memory of the cache.
    fn get(
        &self,
        key: K,
        build: impl FnOnce() -> Result<(V, f64), SceneError>,
    ) -> Result<Arc<V>, SceneError> {
        if let Some(value) = used(&mut self.entries(), &key) {
            return Ok(value);
        }
        // Build without the lock: threads that need the same value may build it twice, but none waits for another value.
        let (value, size) = build()?;
        let mut entries = self.entries();
        if let Some(value) = used(&mut entries, &key) {
            return Ok(value);
        }
        let value = Arc::new(value);
        entries.push(Entry {
            key,
            value: Arc::clone(&value),
            size,
        });
        let is_full = |entries: &[Entry<K, V>]| {
            let size: f64 = entries.iter().map(|entry| entry.size).sum();
            entries.len() > MAX_ENTRIES || size > 1.0
        };
        while entries.len() > 1 && is_full(&entries) {
            entries.remove(0);
        }
        Ok(value)
    }

    /// Locks the entries, also after a panic of another thread.
    fn entries(&self) -> MutexGuard<'_, Vec<Entry<K, V>>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// The value of a key, which becomes the one used last; `None` if it is not kept.
fn used<K: PartialEq, V>(entries: &mut [Entry<K, V>], key: &K) -> Option<Arc<V>> {
    let place = entries.iter().position(|entry| entry.key == *key)?;
    entries[place..].rotate_left(1);
    entries.last().map(|entry| Arc::clone(&entry.value))
}
