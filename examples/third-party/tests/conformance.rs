use third_party::Greedy;

#[test]
fn greedy_keeps_the_laws() {
    pf_conformance::grid::check(Greedy::default);
}
