/* arb_text.c - balls as decimal numbers (arb_certify_impl.h). */
#include <stdlib.h>
#include <string.h>

#include "instrument/certify/arb_certify_impl.h"

/* x <- 10^power */
static void set_power(arb_t x, slong power, slong bits)
{
    arb_set_ui(x, 10);
    fmpz_t e;
    fmpz_init_set_si(e, power);
    arb_pow_fmpz(x, x, e, bits);
    fmpz_clear(e);
}

/* The whole part of log10 of |x|, or less by 1. */
static slong log10_of(const arf_t x)
{
    ISO_BALLS(size, power);
    arb_set_arf(size, x);
    arb_abs(size, size);
    slong e = (slong)((double)arf_abs_bound_lt_2exp_si(x) * 0.3010299956639812) + 1;
    for (set_power(power, e, 64); !arb_le(power, size); set_power(power, e, 64)) e--;
    return e;
}

slong certify_magnitude(arb_srcptr x, int count)
{
    slong largest = 0;
    bool any = false;
    for (int i = 0; i < count; i++) {
        if (arf_is_zero(arb_midref(x + i)) || !arf_is_finite(arb_midref(x + i))) continue;
        const slong e = log10_of(arb_midref(x + i));
        if (!any || e > largest) largest = e;
        any = true;
    }
    return largest;
}

bool certify_holds(arb_srcptr x, int count, slong place)
{
    ISO_BALLS(most, radius);
    set_power(most, place, 64);
    arb_mul_2exp_si(most, most, -1);
    for (int i = 0; i < count; i++) {
        arb_get_rad_arb(radius, x + i);
        if (!(arb_is_finite(x + i) && arb_le(radius, most))) return false;
    }
    return true;
}

/* m 10^place */
static void print_decimal(FILE *to, const fmpz_t m, slong place)
{
    enum { ZEROS = 6 };
    char *text = fmpz_get_str(NULL, 10, m);
    const char *digits = text + (*text == '-');
    const slong length = (slong)strlen(digits), exponent = length - 1 + place;
    if (*text == '-') fputc('-', to);
    if (fmpz_is_zero(m))
        fputs("0", to);
    else if (place > 0 || exponent < -ZEROS)
        fprintf(to, "%c%s%se%ld", digits[0], length > 1 ? "." : "", digits + 1, (long)exponent);
    else if (exponent >= 0)
        fprintf(to, "%.*s%s%s", (int)(exponent + 1), digits, place < 0 ? "." : "", digits + exponent + 1);
    else
        fprintf(to, "0.%.*d%s", (int)(-exponent - 1), 0, digits);
    flint_free(text);
}

/* At least radius, with three digits: the radius times 10^-e, rounded up, is below 1000. */
static void print_radius(FILE *to, const arb_t radius)
{
    ISO_BALLS(scaled);
    fmpz_t digits;
    if (arb_is_zero(radius)) {
        fputs("0", to);
        return;
    }
    fmpz_init(digits);
    const slong place = log10_of(arb_midref(radius)) - 2;
    set_power(scaled, -place, 64);
    arb_mul(scaled, scaled, radius, 64);
    arb_get_ubound_arf(arb_midref(scaled), scaled, 64);
    arf_get_fmpz(digits, arb_midref(scaled), ARF_RND_CEIL);
    print_decimal(to, digits, place);
    fmpz_clear(digits);
}

void certify_print(FILE *to, const arb_t x, slong place, char between)
{
    const slong size =
        arf_is_zero(arb_midref(x)) ? 0 : arf_abs_bound_lt_2exp_si(arb_midref(x)) - 3 * place - place / 3;
    const slong bits = 128 + (size > 0 ? size : 0);
    ISO_BALLS(scaled, power, rest);
    fmpz_t m;
    fmpz_init(m);
    set_power(power, -place, bits);
    arb_mul(scaled, x, power, bits);
    arf_get_fmpz(m, arb_midref(scaled), ARF_RND_NEAR);
    arb_sub_fmpz(rest, scaled, m, bits); /* x = (m + rest) 10^place */
    arb_abs(rest, rest);
    arb_div(rest, rest, power, 64);
    arb_get_ubound_arf(arb_midref(rest), rest, 64);
    mag_zero(arb_radref(rest));
    print_decimal(to, m, place);
    fputc(between, to);
    print_radius(to, rest);
    fmpz_clear(m);
}
