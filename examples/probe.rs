use std::collections::BTreeMap;
use wavestep::{export, language::{Source, read_scene}, network::Network, solution::*};
fn main() {
    for name in std::env::args().skip(1) {
        let text = std::fs::read(&name).unwrap();
        let source = Source::new(&name, text).unwrap();
        let scene = match read_scene(&source, &BTreeMap::new()) { Ok(s) => s, Err(e) => { for d in e { println!("{d}"); } continue } };
        let network = Network::new(&scene).unwrap();
        println!("{name}: lattice {:?} waves {:?}", network.lattice().periods(), network.waves().iter().map(|w| &w.name).collect::<Vec<_>>());
        let statement = network.statement_for_debugging();
        for e in &statement.equations { println!("  {e:?}"); }
        for e in &statement.continuity { println!("  cont {e:?}"); }
        let _ = export::SCHEMA_VERSION;
        let r = match network.recurrence() { Ok(r) => r, Err(e) => { println!("ERR {e}"); continue } };
        let s = Solution::new(r);
        for w in 0..network.waves().len() { println!("{} {:?}", network.waves()[w].name, s.pieces(w, 0, 2)); }
        for o in s.recurrence().statement().observables.clone() { println!("{} {:?}", o.name, s.observed(&o.observation, 0, 1)); }
    }
}
