//! How much contrast the person asks the system for.

use wasm_bindgen::prelude::*;
use web_sys::MediaQueryList;

use crate::ui::Contrast;
use crate::web::{matches_media, media_query};

const FORCED: &str = "(forced-colors: active)";
const MORE: &str = "(prefers-contrast: more)";

/// What is asked for now.
pub(super) fn contrast() -> Contrast {
    if matches_media(FORCED) {
        Contrast::Forced
    } else if matches_media(MORE) {
        Contrast::More
    } else {
        Contrast::Normal
    }
}

/// Asks for a frame when the person asks for another contrast, until it is dropped.
pub(super) struct ContrastWatch {
    queries: Vec<MediaQueryList>,
    on_change: Closure<dyn FnMut()>,
}

impl ContrastWatch {
    pub(super) fn new(ctx: &egui::Context) -> Self {
        let ctx = ctx.clone();
        let on_change = Closure::<dyn FnMut()>::new(move || ctx.request_repaint());
        let queries: Vec<_> = [FORCED, MORE].into_iter().filter_map(media_query).collect();
        for query in &queries {
            // Without it the next frame sees it.
            let _ = query.add_event_listener_with_callback("change", on_change.as_ref().unchecked_ref());
        }
        Self { queries, on_change }
    }
}

impl Drop for ContrastWatch {
    fn drop(&mut self) {
        for query in &self.queries {
            let _ = query.remove_event_listener_with_callback("change", self.on_change.as_ref().unchecked_ref());
        }
    }
}
