//! The words that begin statements, and how each statement is written.

/// A word and an example of the statement that begins with it.
pub(super) type Form = (&'static str, &'static str);

/// How a formula of a listing is written.
pub(super) const FORMULA: &str = "f[3](s) = exp(-s)*(1 + s)";

/// How parameters are stated.
pub(super) const SYMBOL: &str = "symbol mu > 0, r";

/// The statements of a recurrence, the title first.
pub(super) const RECURRENCE: [Form; 9] = [
    ("recurrence", "recurrence \"Title\""),
    ("symbol", SYMBOL),
    ("nonzero", "nonzero a - b"),
    ("period", "period 2*mu, local s, time t"),
    ("wave", "wave f, g"),
    ("equation", "equation g[n] = -f[n-1]"),
    ("continuous", "continuous f[n] + g[n] starts at 1"),
    ("observe", "observe velocity = f[n] + g[n]"),
    ("written", "written f in V/c, s as mu*z/L, constants of f as B"),
];

/// The statements of a scene, the title first.
pub(super) const SCENE: [Form; 13] = [
    ("scene", "scene \"Title\""),
    ("symbol", SYMBOL),
    ("nonzero", "nonzero a - b"),
    ("material", "material steel { modulus = 210 GPa, density = 7850 kg/m^3 }"),
    ("bar", "bar rod { material = steel, diameter = 20 mm, length = 3/2 m }"),
    ("mass", "mass ram { mass = 2 kg, velocity = 1 m/s }"),
    ("spring", "spring cushion { stiffness = 40 kN/mm }"),
    ("hertz", "hertz tip { radius = 6 mm, modulus = 210 GPa, poisson = 3/10 }"),
    ("support", "support toe { damping = 0.3 kN*s/m }"),
    ("load", "load push { force = exp(-t), until = 4 }"),
    ("line", "line free - ram | rod - fixed"),
    ("contacts", "contacts open"),
    ("observe", "observe v = velocity(rod.left) - velocity(ram)"),
];

/// Words that follow an expression in a statement, and so end it.
pub(super) const FOLLOWING: [&str; 3] = ["starts", "local", "time"];
