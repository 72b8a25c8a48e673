/* prove_print.c - the text of prove (study/study.h). */

#include "instrument/prove/prove_impl.h"

static void print_moments(FILE *to, const iso_proof_ball *b)
{
    char text[3][ISO_RATIONAL_SIZE];
    for (int i = 0; i < 3; i++) iso_rational_print(text[i], &b->J[i]);
    fprintf(to, ", J = %s, %s, %s\n", text[0], text[1], text[2]);
}

static void print_proof(FILE *to, const iso_proof *p)
{
    fprintf(to, "k = %s", p->exact);
    print_moments(to, &p->ball);
    fprintf(to, "multiplier of the rotation about axis %d: %s\n", p->middle + 1, p->multiplier.text);
    fprintf(to, "after %ld half returns its unstable manifold meets l = pi/2, on the section n_%d = 0:\n", p->halves,
            p->axis + 1);
    fprintf(to, "x = %s\n", p->x.text);
    fprintf(to, "m = %s\n", p->m.text);
    if (p->axis != p->section)
        fprintf(to, "on n_%d = 0, where it was enclosed: m = %s\n", p->section + 1, p->section_m.text);
    fprintf(to, "%s\n", p->statement);
}

/* The pieces of an interval, from the first to the last that was enclosed. */
static void print_pieces(FILE *to, const iso_proofs *f)
{
    char low[ISO_RATIONAL_SIZE], high[ISO_RATIONAL_SIZE];
    iso_rational_print(low, &f->row[0].ball.k[0]);
    iso_rational_print(high, &f->row[f->rows - 1].ball.k[1]);
    fprintf(to, "k from %s to %s", low, high);
    print_moments(to, &f->row[0].ball);
    iso_table_begin(to, 1);
    fputs("k from\tto\tm from\tto\tdigits\t\n", to);
    for (size_t i = 0; i < f->rows; i++) {
        const iso_proof *p = &f->row[i];
        char text[2][ISO_RATIONAL_SIZE];
        for (int j = 0; j < 2; j++) iso_rational_print(text[j], &p->ball.k[j]);
        fprintf(to, "%s\t%s\t%.6e\t%.6e\t%d\t%s\n", text[0], text[1], p->m.low, p->m.high, p->digits,
                p->sign ? "proved" : "undecided");
    }
    iso_table_end(to);
    if (!f->all)
        fprintf(to, "undecided: a share of %.3g of the interval\n", f->undecided);
    else
        fprintf(to,
                "proved for all these k: m is not 0, so the manifolds cross, and there is no further real-analytic "
                "integral\n");
}

void iso_prove_print(FILE *to, const iso_scene *scene, const void *options, const iso_study_result *result)
{
    const iso_proofs *f = result->found;
    (void)scene, (void)options;
    if (iso_proof_is_thin(&f->row[0].ball))
        print_proof(to, &f->row[0]);
    else
        print_pieces(to, f);
}
