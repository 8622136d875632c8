// Whether a surface or an obstacle acts on a facet. Twin: State::facet_touched in src/state.rs

#if gap
@group(0) @binding(_) var<storage, read> facet_pressed: array<u32>;
#endif
#if obstacles
@group(0) @binding(_) var<storage, read> facet_obstacle: array<u32>;
#endif

fn facet_touched(e: u32) -> bool {
    var touched = false;
#if gap
    touched = facet_pressed[e] > 0u;
#endif
#if obstacles
    touched = touched || facet_obstacle[e] > 0u;
#endif
    return touched;
}
