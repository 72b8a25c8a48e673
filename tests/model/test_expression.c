/* Expressions: each text has the value that C gives it, its slope is that of differences, and what is no expression is
 * refused with the place and the words. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/math_impl.h"
#include "base/vec3_impl.h"
#include "laws.h"
#include "model/expression/written_impl.h"
#include "model/model_impl.h"

static const double J[3] = {1.4, 2.1, 3.0}, n[3] = {0.36, 0.48, 0.8};
static const double a = 0.7, b = -1.3, k = 0.5;

static iso_effects with(iso_effect_id id, int which, const char *text)
{
    iso_effects e = iso_effects_default();
    iso_written *written = &e.written[iso_effect_list[id]->written];
    e.on[id] = true;
    strcpy(written->parameter[0], "a"), strcpy(written->parameter[1], "b_2");
    e.number[id][0] = a, e.number[id][1] = b;
    for (int i = 0; i < ISO_EXPRESSIONS; i++) strcpy(written->expression[i], "0");
    snprintf(written->expression[which], ISO_EXPRESSION_SIZE, "%s", text);
    return e;
}

static void slope_of(const void *problem, const double y[], double value[])
{
    *value = iso_effects_potential(problem, y);
}

/* U at n, and its slope: the torque is k n x dU/dn. */
static void is_worth(const char *text, double wanted)
{
    const iso_params p = laws_params(k, J);
    iso_problem f = {.p = p, .effects = with(ISO_POTENTIAL, 0, text)};
    const double y[ISO_STATE] = {0, 0, 0, n[0], n[1], n[2]};
    double T[3], dy[ISO_STATE], g[3], n_g[3];
    iso_effects_record_motion(&f, false, &f.motion);
    iso_effects_record_energy(&f, &f.energy_formula);
    const double U = iso_effects_potential(&f, y), size = 1 + fabs(wanted);
    for (int i = 0; i < 3; i++) {
        const double along[ISO_STATE] = {[3] = i == 0, [4] = i == 1, [5] = i == 2};
        laws_slope(slope_of, &f, 1, ISO_STATE, y, along, 1.0 / 512, &g[i]);
    }
    iso_effects_torque(&f, y, T, dy);
    cross(n, g, n_g);
    scale(n_g, k);
    const double off = fmax(fabs(T[0] - n_g[0]), fmax(fabs(T[1] - n_g[1]), fabs(T[2] - n_g[2])));
    gsl_test(f.motion.wrong || f.energy_formula.overrun || !(fabs(U - wanted) <= 1e-14 * size),
             "%s: %.17g, not %.17g", text, U, wanted);
    gsl_test(!(off <= 2e-11 * (size + norm(n_g))), "%s: its slope is off by %.2g", text, off);
}

static void values(void)
{
    const double x = n[0], y = n[1], z = n[2];
    is_worth("n1", x);
    is_worth("  1 + n1*2\t-n2", 1 + 2 * x - y);
    is_worth("-n1^2", -x * x);
    is_worth("(-n1)^2", x * x);
    is_worth("2^-n1^2", pow(2, -x * x));
    is_worth("2^n1^2 - (2^n1)^2", pow(2, x * x) - pow(4, x));
    is_worth("n1 - n2 - n3", x - y - z);
    is_worth("n1/n2/n3", x / y / z);
    is_worth("n1/n2*n3", x / y * z);
    is_worth("- - n1 + + n2", x + y);
    is_worth("2*-n1", -2 * x);
    is_worth("1.5e-1*n1 + .5*n2 + 2.*n3 + 1E+1*n1", 0.15 * x + 0.5 * y + 2 * z + 10 * x);
    is_worth("a*n1 + b_2*n2", a * x + b * y);
    is_worth("k*n1*J1 + n2*J2/J3", k * x * J[0] + y * J[1] / J[2]);
    is_worth("pi*n1", ISO_PI * x);
    is_worth("sqrt(4)*exp(1)*log(2)*sin(1)*cos(1)*tan(1)*3^0.5*n1",
             2 * exp(1) * log(2) * sin(1) * cos(1) * tan(1) * sqrt(3) * x);
    is_worth("sqrt(n1) + exp(n2) + log(n3) + sin(n1) + cos(n2) + tan(n3)",
             sqrt(x) + exp(y) + log(z) + sin(x) + cos(y) + tan(z));
    is_worth("n1^3 - n2^4*n1 + n3^7 + n1^1", x * x * x - pow(y, 4) * x + pow(z, 7) + x);
    is_worth("n1^-1 + n2^(-3) + n3^0.5", 1 / x + pow(y, -3) + sqrt(z));
    is_worth("(n1 - n2)^3*(n2 - 1)^2*(1 - n3)", pow(x - y, 3) * (y - 1) * (y - 1) * (1 - z));
    is_worth("n1^n2 + a^n3 + n1^a", pow(x, y) + pow(a, z) + pow(x, a));
    is_worth("(n1 + n2)*(n2 - 2*n3 + 1) + (n1*n2 + n3)^2/3", (x + y) * (y - 2 * z + 1) + pow(x * y + z, 2) / 3);
    is_worth("3 - (n1*n1 + n2^2)/a/2 - n3*(1 - n3)", 3 - (x * x + y * y) / a / 2 - z * (1 - z));
    is_worth("sin(n1)^2 + cos(n1)^2 + n2", 1 + y);
    is_worth("0.3*n1^2 + 0.1/(1.2 - n3)", 0.3 * x * x + 0.1 / (1.2 - z));
    is_worth("exp(-(n1^2/J1 + n2^2/J2 + n3^2/J3)^(-1/k))",
             exp(-pow(x * x / J[0] + y * y / J[1] + z * z / J[2], -1 / k)));
}

/* --- what is refused -------------------------------------------------------------------------------------------- */

static iso_context *ctx;

static void is_wrong(iso_effect_id id, const char *text, int column, const char *words)
{
    const iso_params p = laws_params(k, J);
    const double start[ISO_STATE] = {0.9, -0.3, -0.225, n[0], n[1], n[2]};
    iso_effects e = with(id, 0, text);
    char place[48];
    snprintf(place, sizeof place, "column %d of the text: ", column);
    const iso_status status = iso_effects_check(ctx, &p, start, &e);
    const char *message = iso_context_message(ctx);
    gsl_test(status != ISO_BAD_INPUT || !strstr(message, place) || !strstr(message, words), "'%.40s': %s", text,
             status == ISO_OK ? "accepted" : message);
}

static void refused(void)
{
    char deep[ISO_EXPRESSION_SIZE] = "", many[ISO_EXPRESSION_SIZE] = "";
    for (int i = 0; i < 33; i++) strcat(deep, "(");
    strcpy(many, "n1");
    for (int i = 0; i < 254; i++) snprintf(many + strlen(many), 3, "+%d", i % 10);
    is_wrong(ISO_POTENTIAL, "n1 n2", 4, "expected an operator before 'n': a product is written a*b");
    is_wrong(ISO_POTENTIAL, "n1 + ", 6, "expected a number, a name or '(', not the end");
    is_wrong(ISO_POTENTIAL, "n1**2", 3, "a power is written x^y");
    is_wrong(ISO_POTENTIAL, "(n1", 4, "expected ')' that closes the '(' in column 1 of the text, not the end");
    is_wrong(ISO_POTENTIAL, "n1)", 3, "')' closes no '('");
    is_wrong(ISO_POTENTIAL, "sin n1", 4, "expected '(': 'sin' is a function");
    is_wrong(ISO_POTENTIAL, "abs(n1)", 1, "sqrt(x^2 + a^2)");
    is_wrong(ISO_POTENTIAL, "n1 + t", 6, "the equations do not change with time");
    is_wrong(ISO_POTENTIAL, "n4", 1, "unknown name 'n4'");
    is_wrong(ISO_POTENTIAL, "sinh(n1)", 1, "unknown function 'sinh'; did you mean 'sin'?");
    is_wrong(ISO_POTENTIAL, "n1 + omega1", 6, "a potential depends on n alone: 'omega1' is for 'torque'");
    is_wrong(ISO_POTENTIAL, "n1 + e1", 6, "is for 'torque'");
    is_wrong(ISO_TORQUE, "n1 + e1", 6, "it needs the effect 'gravity'");
    is_wrong(ISO_POTENTIAL, "n1 + 1e999", 6, "is no number of double precision");
    is_wrong(ISO_POTENTIAL, "1.2.3*n1", 1, "is no number of double precision");
    is_wrong(ISO_POTENTIAL, "n1 + \xc3\xa9", 6, "byte 0xC3");
    is_wrong(ISO_POTENTIAL, "n1 & n2", 4, "expected an operator (+ - * / ^) or the end, not '&'");
    is_wrong(ISO_POTENTIAL, "n1/(1 - 1)", 3, "a division by 0");
    is_wrong(ISO_POTENTIAL, "n1 + 1/(a - 0.7)", 7, "a division by 0");
    is_wrong(ISO_POTENTIAL, "n1 + log(b_2)", 6, "log of -1.3");
    is_wrong(ISO_POTENTIAL, "n1 + sqrt(-4)", 6, "sqrt of -4");
    is_wrong(ISO_POTENTIAL, "n1 + (-2)^0.5", 10, "-2 to the power 0.5");
    is_wrong(ISO_POTENTIAL, deep, 33, "nested more than 32 deep");
    is_wrong(ISO_POTENTIAL, many, 493, "at most 256");
    static const char *const corners[] = {
        "(sqrt(n1^2))",       "(sqrt((n1+2*n2)^2))", "((n1*n1)^1.5)",    "((n1*n1)^-0.5)",
        "((n1^6)^0.5)",       "(sqrt(3*n1^2/n2))",   "(sqrt(n1*n1*n3))", "((n1^k)^0.5*0+(n2^4)^-1.25)",
        "(sqrt((2+n3)/n1^2))"};
    for (size_t i = 0; i < sizeof corners / sizeof *corners; i++)
        is_wrong(ISO_TORQUE, corners[i], corners[i][1] == 's' ? 2 : (int)(strrchr(corners[i], '^') - corners[i]) + 1,
                 "the root of an even power");
    static const char *const smooth[] = {"sqrt((n1^2)^2)", "sqrt(n1^2*n1^2)", "sqrt((n1^2+n2^4)^2)",
                                         "(n1*n1*n2^2)^2", "sqrt(1+n1^2)",    "sqrt(sqrt(1+n1^2)^2)"};
    for (size_t i = 0; i < sizeof smooth / sizeof *smooth; i++) {
        const iso_params p = laws_params(k, J);
        const double start[ISO_STATE] = {0.9, -0.3, -0.225, n[0], n[1], n[2]};
        iso_effects e = with(ISO_TORQUE, 0, smooth[i]);
        gsl_test(iso_effects_check(ctx, &p, start, &e) != ISO_OK, "'%s' has no corner", smooth[i]);
    }
}

/* --- a value with the size of its error, and how near it is to its end ------------------------------------------ */

static iso_expression_state at_state(void)
{
    static const double parameter[ISO_PARAMETERS] = {0.7, -1.3};
    return (iso_expression_state){k, {J[0], J[1], J[2]}, {n[0], n[1], n[2]}, {3, 0, -4}, {0, 0.6, 0.8}, parameter};
}

static iso_expression expression_of(const char *text)
{
    const iso_effects e = with(ISO_TORQUE, 0, text);
    iso_expression x;
    gsl_test(!iso_written_read(&e, ISO_TORQUE, 0, &x), "%s is read", text);
    return x;
}

static void has_size(const char *text, double wanted, double wanted_size)
{
    const iso_expression x = expression_of(text);
    const iso_expression_state s = at_state();
    double size;
    const double value = iso_expression_value(&x, &s, &size);
    gsl_test(!(fabs(value - wanted) <= 1e-15 * wanted_size), "%s: %.17g, not %.17g", text, value, wanted);
    gsl_test(!(fabs(size - wanted_size) <= 1e-15 * wanted_size), "%s: size %.17g, not %.17g", text, size,
             wanted_size);
}

static void has_margin(const char *text, double wanted, const char *words)
{
    iso_expression x = expression_of(text);
    const iso_expression_state s = at_state();
    const double margin = iso_expression_margin(&x, &s);
    const bool same = margin == wanted || fabs(margin - wanted) <= 1e-11 * wanted;
    gsl_test(!same || (words && strcmp(x.wrong, words) != 0), "%s: %g, not %g: %s", text, margin, wanted, x.wrong);
}

/* To first order: n and e change by 1, omega by 5. */
static void sizes(void)
{
    has_size("n1", 0.36, 1);
    has_size("omega2 + 0", 0, 5);
    has_size("omega1 - omega3", 7, 10);
    has_size("a*omega1*n2", 0.7 * 3 * 0.48, 0.7 * (5 * 0.48 + 3));
    has_size("omega3^2 + e3", 16.8, 2 * 4 * 5 + 1);
    has_size("J1*k/n1", 0.7 / 0.36, 0.7 / (0.36 * 0.36));
    has_size("sqrt(n2) + log(n3)", sqrt(0.48) + log(0.8), 0.5 / sqrt(0.48) + 1 / 0.8);
    has_margin("n1*omega2^3 + exp(n2)", INFINITY, NULL);
    has_margin("1/omega1 + log(n1 - 0.3599)", 1e-4, "log of 0.0001");
    has_margin("2/(omega3 + 4)", 0, "a division by 0");
    has_margin("sqrt(0.35 - n1)", 0, NULL);
}

int main(void)
{
    ctx = iso_context_create();
    values();
    refused();
    sizes();
    iso_context_free(ctx);
    exit(gsl_test_summary());
}
