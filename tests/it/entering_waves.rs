//! The waves that enter the bars: fronts at enclosed instants, and their integrals.

use wavestep::ball::Ball;
use wavestep::expression::Fraction;
use wavestep::field::wave::{Entering, Heading, Instant, Order, Waves};
use wavestep::language::{Source, parse_number, read_scene};
use wavestep::limits::MAX_HISTORY_BITS;
use wavestep::network::Network;
use wavestep::signal::{Limit, digits};
use wavestep_polynomial::Rational;

fn number(text: &str) -> Rational {
    parse_number(text).unwrap()
}

fn built_in(name: &str) -> Network {
    let values = [("mu".to_owned(), number("1"))].into();
    let source = Source::new(name, wavestep::scenes::find(name).unwrap().text).unwrap();
    Network::new(&read_scene(&source, &values).unwrap()).unwrap()
}

const ROD: Entering = Entering { bar: 0, heading: Heading::Right };

/// The mass leaves at 3 + e^(−2)/2. The number that stands for it means it in pictures, with a slope
/// on either side; exactly, it is some other instant, which more bits tell from it or which is a tie, and told.
#[test]
fn a_number_stands_for_an_enclosed_instant() {
    let network = built_in("saint-venant");
    let fields = Waves::new(&network, &number("31/10")).unwrap();
    let window = ["301/100", "31/10"].map(|time| Fraction::constant(&number(time)));
    let fronts = fields.fronts(ROD, window.each_ref()).unwrap();
    let [release] = &fronts[..] else { panic!("{fronts:?}") };
    let (told, _) = fields.numbers.enclose(release, 64).unwrap().to_double();
    assert!((told - 3.0 - (-2.0_f64).exp() / 2.0).abs() < 1e-15);
    let ask = |at, order, side, is_drawn| {
        let instant = Instant { at, side, is_drawn };
        fields.value(ROD, order, instant, 64).map(|ball| ball.to_double().0)
    };
    let drawn = |order, side| ask(release, order, side, true).unwrap();
    for order in [Order::Value, Order::Integral] {
        let (left, right) = (drawn(order, Limit::Left), drawn(order, Limit::Right));
        assert!((left - right).abs() < 1e-15 && left.abs() > 0.1, "{order:?} {left} {right}");
    }
    let slopes = [Limit::Left, Limit::Right].map(|side| drawn(Order::Slope, side));
    assert!((slopes[0] - slopes[1]).abs() > 0.1, "{slopes:?}");
    let exact = [Limit::Left, Limit::Right].map(|side| ask(release, Order::Slope, side, false));
    assert!(exact[0].is_ok() && exact[0] == exact[1]);
    let decay = Ball::from_integer(&(-2).into()).exp(2 * MAX_HISTORY_BITS).unwrap();
    let near = number("3") + Rational::from(decay.midpoint()) / number("2");
    let near = Fraction::constant(&near);
    let tied = ask(&near, Order::Value, Limit::Right, false).unwrap();
    assert!((tied - drawn(Order::Value, Limit::Right)).abs() < 1e-15, "{tied}");
    let told = network.assumed.all();
    assert!(
        told.iter().any(|told| told.contains("two instants at t = 3.06766764162 are one")),
        "{told:?}"
    );
}

/// Integrals are those of what they are integrals of: by the rule of Simpson, within its error.
#[test]
fn integrals_follow_the_wave() {
    for name in ["saint-venant", "mass-on-fixed-bar"] {
        let network = built_in(name);
        let fields = Waves::new(&network, &number("4")).unwrap();
        let value = |order, thousandths: i64| {
            let at = Fraction::constant(&Rational::new(thousandths.into(), 1000.into()));
            let instant = Instant { at: &at, side: Limit::Right, is_drawn: false };
            fields.value(ROD, order, instant, 64).unwrap().to_double().0
        };
        for from in [0_i64, 950, 1300, 2100, 3040, 3800] {
            let orders = [Order::Slope, Order::Value, Order::Integral, Order::DoubleIntegral];
            for pair in orders.windows(2) {
                let [start, middle, end] =
                    [from, from + 25, from + 50].map(|time| value(pair[0], time));
                let rule = 0.05 / 6.0 * (start + 4.0 * middle + end);
                let gain = value(pair[1], from + 50) - value(pair[1], from);
                let error = if from == 3040 { 1e-2 } else { 1e-7 };
                assert!((rule - gain).abs() < error, "{name} {pair:?} from {from}: {rule} {gain}");
            }
        }
        let levels = fields.entering[ROD.bar][ROD.heading as usize].as_ref().unwrap();
        let orders = [Order::Value, Order::Integral, Order::DoubleIntegral];
        for (level, order) in levels.iter().zip(orders) {
            let digits = digits(&**level, &number("2.1"), Limit::Right, 15, 1 << 12).unwrap();
            assert!((digits.to_f64() - value(order, 2100)).abs() < 1e-14, "{name} {order:?}");
        }
        assert_eq!(value(Order::Value, -10), 0.0);
        assert_eq!(value(Order::DoubleIntegral, 0), 0.0);
    }
}
