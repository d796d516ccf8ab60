//! Exporting: the open model as a file of another format, for scripts.

use std::cell::Cell;
use std::rc::Rc;

use js_sys::{Array, Promise, Uint8Array};
use wasm_bindgen::prelude::*;

use crate::script::{self, Misuse};
use crate::session::{ExportFormat, ExportJob, ExportOptions, ExportRange, ExportRefusal, ExportedFile};
use crate::slices::{Sliced, Slices};
use crate::web::arguments::{checked, given, optional};
use crate::web::shared::Shared;
use crate::web::timings::SLICE_SECS;
use crate::web::viewer::Viewer;
use crate::web::{field, is_absent, next_task, now_secs, object, promise};

#[wasm_bindgen]
impl Viewer {
    /// Writes the open model as one sees it, with edited materials and given names: `{format, clips, inPlace, range, closeLoop, reduce, forBook}`.
    /// The format is `glb`, `d3d12`, `d3d11` or `txt`; clips are names, the range of the only one is `[from, to]` in seconds, `closeLoop` is
    /// seconds, `reduce` a fraction of the model's size. What is absent changes nothing; a range that is absent is the timeline's where its
    /// clip is the only one. Resolves with `{name, bytes, changes, losses}`; rejects when it cannot be written.
    ///
    /// # Errors
    /// When a field is of another type or makes no sense.
    #[wasm_bindgen(js_name = exportModel)]
    pub fn export_model(&self, options: &JsValue) -> Result<Promise, JsValue> {
        let options = read(options)?;
        let job = self.shared.session.borrow().export_job(&options);
        let shared = Rc::clone(&self.shared);
        Ok(promise(async move {
            match job {
                Some(job) => written(&shared, job).await,
                None => Err(JsError::new("no model is open")),
            }
        }))
    }
}

/// Plans and writes a file in slices, each in a task of its own.
async fn written(shared: &Shared, job: ExportJob) -> Result<JsValue, JsError> {
    let ends_secs = Rc::new(Cell::new(0.0));
    let slices = Slices::new({
        let ends_secs = Rc::clone(&ends_secs);
        move || now_secs() >= ends_secs.get()
    });
    let mut work = Sliced::new(&slices, async move |slices| {
        job.plan(&slices).await?.write(&slices).await
    });
    loop {
        next_task().await;
        if shared.is_silenced() {
            return Err(JsError::new("the viewer was freed"));
        }
        ends_secs.set(now_secs() + SLICE_SECS);
        if let Some(written) = work.advance() {
            let written = written.map_err(|refusal: ExportRefusal| JsError::new(&refusal.to_string()));
            return Ok(told(&written?));
        }
    }
}

fn told(file: &ExportedFile) -> JsValue {
    let changes = file.plan.changes.iter();
    let changes = changes.map(|change| object([("code", change.code.into()), ("message", (&*change.message).into())]));
    let losses = file.plan.losses.iter().map(|loss| {
        object([
            ("code", loss.code.into()),
            ("message", (&*loss.message).into()),
            ("count", (loss.count as f64).into()),
        ])
    });
    object([
        ("name", (&*file.name).into()),
        ("bytes", Uint8Array::from(file.bytes.as_slice()).into()),
        ("changes", changes.collect::<Array>().into()),
        ("losses", losses.collect::<Array>().into()),
    ])
}

fn read(options: &JsValue) -> Result<ExportOptions, JsValue> {
    if !options.is_object() {
        let message = format!("export takes an object, not {}", given(options));
        return checked(Err(Misuse::Type(message)));
    }
    let format = field(options, "format");
    let format = if is_absent(&format) {
        Some(ExportFormat::default())
    } else {
        format.as_string().and_then(|name| ExportFormat::from_name(&name))
    };
    let of_type = |wanted: &str| Misuse::Type(format!("export({wanted}"));
    let clips = list(&field(options, "clips"), |name| name.as_string());
    let clips = checked(clips.ok_or_else(|| of_type("{clips}) takes an array of names")))?;
    let range = list(&field(options, "range"), |secs| secs.as_f64());
    let range = range.map(|secs| secs.map(|secs| <[f64; 2]>::try_from(secs).ok()));
    let range = match range {
        Some(None) => ExportRange::Timeline,
        Some(Some(Some(secs))) => ExportRange::Secs(secs.map(|secs| secs as f32)),
        _ => return checked(Err(of_type("{range}) takes an array of two times in seconds"))),
    };
    Ok(ExportOptions {
        format: checked(
            format.ok_or_else(|| Misuse::Range("export({format}) takes glb, d3d12, d3d11 or txt".to_owned())),
        )?,
        clips,
        in_place: field(options, "inPlace").is_truthy(),
        range,
        close_loop_secs: optional(&field(options, "closeLoop"), |secs| {
            script::factor("export({closeLoop})", secs)
        })?,
        reduce: optional(&field(options, "reduce"), |fraction| {
            script::factor("export({reduce})", fraction)
        })?,
        for_book: field(options, "forBook").is_truthy(),
    })
}

/// An array of values of one type; `None` for anything else, and `Some(None)` for nothing.
fn list<T>(value: &JsValue, read: impl Fn(JsValue) -> Option<T>) -> Option<Option<Vec<T>>> {
    if is_absent(value) {
        return Some(None);
    }
    value
        .dyn_ref::<Array>()?
        .iter()
        .map(read)
        .collect::<Option<_>>()
        .map(Some)
}
