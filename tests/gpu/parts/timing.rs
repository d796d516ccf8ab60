//! Times of passes.

use bindpose::render::for_tests::sums;
use bindpose::scene::TimedPass;

#[test]
fn passes_of_one_kind_are_summed_and_no_time_is_counted_twice() {
    use TimedPass::{AmbientOcclusion, Geometry, Picture, ShadowMap};
    let passes = [ShadowMap, Geometry, AmbientOcclusion, AmbientOcclusion, Picture];
    let stamps = [100, 110, 105, 120, 130, 140, 140, 145, 150, 149];
    let sums = sums(&passes, &stamps, 0.5);
    for (pass, secs) in [
        (ShadowMap, 5.0),
        (Geometry, 5.0),
        (AmbientOcclusion, 7.5),
        (TimedPass::Contact, 0.0),
        (Picture, 0.0),
    ] {
        assert_eq!(sums[pass as usize], secs, "{pass:?}");
    }
}
