//! The style sheet that all figures share.

/// The colors s0 to s7 are those of Okabe and Ito, but yellow is darker on white, and blue and black are
/// lighter on black, to be visible.
pub(super) const SHEET: &str = r#".page{fill:#fff}
text{fill:#1f2328;font:12px system-ui,-apple-system,"Segoe UI",Roboto,Helvetica,Arial,sans-serif}
.title{font-size:16px;font-weight:600}
.small{font-size:11px}
.strong{font-weight:600}
.muted{fill:#59636e}
.halo{stroke:#fff;stroke-width:3px;stroke-linejoin:round;paint-order:stroke}
.grid{stroke:#e4e8ec;stroke-width:1}
.axis{stroke:#818b98;stroke-width:1}
.outline{fill:none}
.leader{stroke:#818b98;stroke-width:.75}
.edge{stroke:#818b98;stroke-width:1.25}
.curve{fill:none;stroke:currentColor;stroke-width:1.75;stroke-linejoin:round}
.thin{stroke-width:1.25}
.mark{fill:currentColor;stroke:#fff;stroke-width:.75}
.hollow{fill:#fff;stroke:currentColor;stroke-width:1.5}
.wall{fill:#8c959f}
.badge{fill:#1f2328;stroke:#fff;stroke-width:1.5}
.onbadge{fill:#fff;font-size:11px;font-weight:700}
.node{fill:#fff;stroke:#818b98;stroke-width:1.25}
.leaf{fill:#ddf0fa;stroke:#0072b2;stroke-width:1.75}
.s0{color:#0072b2}.s1{color:#d55e00}.s2{color:#009e73}.s3{color:#cc79a7}
.s4{color:#e69f00}.s5{color:#56b4e9}.s6{color:#000}.s7{color:#b3a500}.r{color:#59636e}
.d1{stroke-dasharray:7 3}.d2{stroke-dasharray:2 2.5}.d3{stroke-dasharray:9 3 2 3}.d4{stroke-dasharray:13 4}
@media (prefers-color-scheme:dark){
.page,.hollow,.node{fill:#0d1117}
text{fill:#e6edf3}
.muted{fill:#9198a1}
.halo,.mark{stroke:#0d1117}
.grid{stroke:#242a32}
.axis,.leader,.edge,.node{stroke:#6e7681}
.wall{fill:#59616b}
.badge{fill:#e6edf3;stroke:#0d1117}
.onbadge{fill:#0d1117}
.leaf{fill:#10304a;stroke:#56b4e9}
.s0{color:#4a9fe0}.s6{color:#f0f6fc}.s7{color:#f0e442}.r{color:#9198a1}
}"#;
