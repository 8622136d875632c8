// A strength that does not give way. Twin: src/material/elastic.rs
#import flow

// Never asked: a body whose yield stress is 0 does not yield.
fn flow_elastic(body: Body, at: Point) -> Flow {
    return Flow(0.0, 0.0, 0.0);
}
