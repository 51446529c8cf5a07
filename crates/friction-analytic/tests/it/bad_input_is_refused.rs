use casebook::assert_matches;
use friction_analytic::{ElasticContact, FrictionError, high_speed_friction, low_speed_friction};
use indenters::{IndenterError, Sphere};
use rheology::{StandardSolid, StandardSolidParameters};

#[test]
fn elastic_contacts_that_cannot_be_are_refused() {
    let sphere = Sphere::new(1.0).unwrap();
    let solid = StandardSolid::new(StandardSolidParameters {
        equilibrium_modulus: 1.0,
        maxwell_modulus: 2.0,
        viscosity: 3.0,
    })
    .unwrap();
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        for (name, contact) in [
            (
                "velocity",
                ElasticContact {
                    contact_radius: 0.5,
                    velocity: bad,
                },
            ),
            (
                "contact_radius",
                ElasticContact {
                    contact_radius: bad,
                    velocity: 1.0,
                },
            ),
        ] {
            for result in [
                low_speed_friction(&sphere, &solid, contact),
                high_speed_friction(&sphere, &solid, contact),
            ] {
                let named = matches!(
                    result,
                    Err(FrictionError::InvalidParameter { parameter, .. }) if parameter == name
                );
                assert!(named, "{contact:?}: {result:?} instead of {name}");
            }
        }
    }
    let beyond = ElasticContact {
        contact_radius: 1.0,
        velocity: 1.0,
    };
    let result = low_speed_friction(&sphere, &solid, beyond);
    assert_matches!(
        result,
        Err(FrictionError::Indenter(IndenterError::OutOfDomain { .. })),
        " at the equator of the sphere"
    );
}
