//! The order of triangles in the file.

/// Vertices that a small GPU keeps shaded.
const CACHE_SIZE: usize = 16;

/// Where the triangles are in an order in which most corners were shaded shortly before: fans around one vertex after another, the
/// next one chosen among those that are still kept (Tipsify: Sander, Nehab, Barczak, "Fast Triangle Reordering for Vertex Locality
/// and Reduced Overdraw", 2007).
pub(crate) fn for_vertex_cache(triangles: &[[u32; 3]]) -> Vec<usize> {
    let vertex_count = triangles.iter().flatten().max().map_or(0, |last| *last as usize + 1);
    let mut around = vec![Vec::new(); vertex_count];
    for (triangle, corners) in triangles.iter().enumerate() {
        for &corner in corners {
            around[corner as usize].push(triangle);
        }
    }
    // Triangles at each vertex that are not in the order.
    let mut left: Vec<usize> = around.iter().map(Vec::len).collect();
    // When each vertex was shaded last; time counts shaded vertices.
    let mut shaded_at = vec![0; vertex_count];
    let mut now = CACHE_SIZE + 1;
    let mut is_in_order = vec![false; triangles.len()];
    let mut order = Vec::with_capacity(triangles.len());
    let mut used = Vec::new();
    let mut unused = 0..vertex_count;
    let mut center = unused.next();
    while let Some(vertex) = center {
        let first_of_fan = used.len();
        for &triangle in &around[vertex] {
            if std::mem::replace(&mut is_in_order[triangle], true) {
                continue;
            }
            order.push(triangle);
            for corner in triangles[triangle].map(|corner| corner as usize) {
                used.push(corner);
                left[corner] -= 1;
                if now - shaded_at[corner] > CACHE_SIZE {
                    shaded_at[corner] = now;
                    now += 1;
                }
            }
        }
        // The oldest vertex that stays in the cache while its own fan is drawn; it would be lost next.
        let age = |vertex: usize| now - shaded_at[vertex];
        let stays = |vertex: usize| age(vertex) + 2 * left[vertex] <= CACHE_SIZE;
        let in_fan = used[first_of_fan..].iter().copied().filter(|&vertex| left[vertex] > 0);
        center = in_fan
            .max_by_key(|&vertex| if stays(vertex) { age(vertex) } else { 0 })
            .or_else(|| {
                while let Some(vertex) = used.pop() {
                    if left[vertex] > 0 {
                        return Some(vertex);
                    }
                }
                unused.find(|&vertex| left[vertex] > 0)
            });
    }
    order
}
