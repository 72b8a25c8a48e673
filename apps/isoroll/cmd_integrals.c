/* isoroll integrals - searches for additional first integrals: polynomials in M that are constant on many orbits. */
#include "command.h"
#include "instrument/integrals/integrals_impl.h"

OPTIONS_OF_SCENE(iso_integral_search_options);

static const option_row rows[] = {
    ROWS_OF_STUDY(iso_integrals_option),
    ROW_JSON(options, shell.json),
    ROW_END,
};

const command command_integrals = {
    COMMAND_OF_SCENE(integrals),
    .parts = {.stopped = "what is known by now is printed"},
    .description =
        "Looks for functions of the point's state that are constant along orbits: polynomials in M of degree D or "
        "less, with coefficients that are polynomials in gamma of degree E or less. Of the scene it reads k, J and "
        "the level of the energy: that of a point, or of a ball with the effect 'level'. With the effect 'rotor' it "
        "also reads the energy and the rotor's momentum; functions then have the factor q^(-1/(2k)) as well, and "
        "degree 4 takes 10 seconds and more. Orbits start spread evenly over a section and are sampled at many "
        "times. The singular values of the samples tell how little a function of this space can vary along orbits, "
        "relative to its own size.\n\n"
        "The table has a line for each degree: how many independent functions there are, how many of them are "
        "integrals, how many are new (not the energy, and not found two degrees lower, with a rotor one; products of "
        "integrals are counted as new), and the smallest value of the others. On each level the energy is constant; "
        "it is the one integral of degree 2, with a rotor of degree 1, that every ball has.\n\n"
        "Integrals that are known for this k and J are named where they are found. 'undecided': a value lies "
        "between its own error and --within, or k and J are almost those of an integrable ball, or the search was "
        "stopped.\n\n"
        "The line 'theory' does not depend on the search. It says 'integrable' (a second integral is known), 'no "
        "meromorphic integral' (a theorem of ours, not reviewed) or 'open', and why.",
    .example = "isoroll integrals scene.yaml --degree 4",
    .exits = "1: interrupted\n"
             "3: bad input: an effect that acts, other than 'level' and 'rotor', or k too near 0\n"
             "4: the computation failed, or no memory",
};
