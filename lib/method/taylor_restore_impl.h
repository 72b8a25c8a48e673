/* taylor_restore_impl.h - what brings a state back to its constraints after a step, for taylor_method_impl.h.
 *
 * Corrections are small, and their defects computed exactly: a projection that rounds its defect turns each step the same
 * way, and the phase drifts like t^2.
 */

/* (a,b) - target with the rounding of one number only (Dot2 of Ogita, Rump and Oishi). */
static REAL NAME(defect)(const REAL a[], const REAL b[], int count, REAL target)
{
    REAL sum = -target, lost = 0;
    for (int i = 0; i < count; i++) {
        const REAL p = a[i] * b[i], p_lost = FMA(a[i], b[i], -p);
        const REAL next = sum + p, part = next - sum;
        lost += ((sum - (next - part)) + (p - part)) + p_lost;
        sum = next;
    }
    return sum + lost;
}

/* Makes |a|^2 the target; gives the relative correction. */
static REAL NAME(restore_length)(REAL a[], int count, REAL target)
{
    REAL worst = 0;
    for (int pass = 0; pass < 3; pass++) {
        const REAL part = NAME(defect)(a, a, count, target) / (2 * target);
        for (int i = 0; i < count; i++) a[i] -= part * a[i];
        worst += FABS(part);
        if (FABS(part) < (REAL)1e-9) break;
    }
    return worst;
}

/* |gamma'|^2 on the level: 2 (E - V) in s; B k q^2 in t */
static REAL NAME(square_of_speed)(const iso_model *m, NAME(taylor) *T, const REAL gamma[3])
{
    NAME(series) *S = &T->S;
    REAL q = 0, P = 0, L = 0;
    for (int i = 0; i < 3; i++) q += gamma[i] * S->J[i] * gamma[i];
    if (T->in_t) return S->coupling * S->k * q * q;
    const REAL fall = EXP(-LOG(q) / S->k);
    REAL square = 2 * (S->energy + (REAL)m->field.eps * fall);
    if (!S->in_field) return square;
    for (int i = 0; i < 3; i++) {
        L += S->l[i] * gamma[i];
        for (int j = 0; j < 3; j++) P += gamma[i] * S->C[i][j] * gamma[j] / 2;
    }
    return square - 2 * S->factor * fall * (P / q + L / ROOT(q));
}

/* The second integral of k = -1, F = (M,JM)/det J + 2 eps (gamma,J^-1 gamma), M = gamma' x gamma, against its value at the
 * start. Left alone it goes at random by a rounding error a step, the frequencies with it, and the phase like t^(3/2). */
static REAL NAME(shell_defect)(const NAME(taylor) *T, const NAME(state) *s, REAL M[3])
{
    const NAME(series) *S = &T->S;
    const REAL det = S->factor * S->k * S->k;
    REAL JM[6], MM[6];
    NAME(cross_product)(s->w, s->n, M);
    for (int i = 0; i < 3; i++) {
        MM[i] = M[i];
        JM[i] = S->J[i] * M[i] / det;
        MM[3 + i] = s->n[i];
        JM[3 + i] = -S->coupling * S->inv_J[i] * s->n[i]; /* coupling = -2 eps */
    }
    return NAME(defect)(MM, JM, 6, T->second);
}

/* Turns gamma' in the tangent plane, which leaves all else; not where F does not feel it. */
static void NAME(restore_second)(const NAME(taylor) *T, NAME(state) *s)
{
    const NAME(series) *S = &T->S;
    REAL M[3], slope = 0, across[3];
    const REAL defect = NAME(shell_defect)(T, s, M), det = S->factor * S->k * S->k;
    for (int i = 0; i < 3; i++) slope += 2 * s->w[i] * S->J[i] * M[i] / det;
    if (!(FABS(slope) > (REAL)0.1 * FABS(T->second)) || FABS(defect) > (REAL)1e-9 * FABS(T->second)) return;
    NAME(cross_product)(s->n, s->w, across);
    for (int i = 0; i < 3; i++) s->w[i] -= defect / slope * across[i];
}

static REAL NAME(restore_point)(const iso_model *m, NAME(taylor) *T, NAME(state) *s)
{
    REAL worst = NAME(restore_length)(s->n, 3, 1);
    const REAL along = NAME(defect)(s->n, s->w, 3, 0);
    for (int i = 0; i < 3; i++) s->w[i] -= along * s->n[i];
    const REAL square = NAME(square_of_speed)(m, T, s->n);
    const REAL now = s->w[0] * s->w[0] + s->w[1] * s->w[1] + s->w[2] * s->w[2];
    if (square > 0 && now > square / 2 && now > (REAL)0.1 * FABS(2 * T->S.energy))
        worst += NAME(restore_length)(s->w, 3, square);
    if (T->S.term[0] == NAME(neumann)) NAME(restore_second)(T, s);
    return worst;
}

/* (w,n) = 0 of a ball that does not twist; a free ball's energy. */
static REAL NAME(restore_ball)(const iso_model *m, NAME(taylor) *T, NAME(state) *s)
{
    NAME(series) *S = &T->S;
    REAL worst = NAME(restore_length)(s->n, 3, 1), K[3];
    if (m->field.effects.on[ISO_TWIST]) return worst;
    const REAL spin = NAME(defect)(s->w, s->n, 3, 0);
    for (int i = 0; i < 3; i++) s->w[i] -= spin * s->n[i];
    if (m->forces > 0) return worst;
    for (int i = 0; i < 3; i++) K[i] = S->J[i] * s->w[i];
    const REAL twice = 2 * S->energy;
    if (!(twice > 0)) return worst;
    const REAL part = NAME(defect)(s->w, K, 3, twice) / (2 * twice);
    for (int i = 0; i < 3; i++) s->w[i] -= part * s->w[i];
    return worst + FABS(part);
}

static void NAME(restore)(iso_integrator *it, NAME(taylor) *T, NAME(state) *s)
{
    const iso_model *m = &it->model;
    if (it->options.no_projection && !T->is_point) return; /* off them a point's equations are unstable */
    REAL worst = T->is_point ? NAME(restore_point)(m, T, s) : NAME(restore_ball)(m, T, s);
    if (m->field.at[ISO_GRAVITY]) worst += NAME(restore_length)(s->e, 3, 1);
    if (m->field.at[ISO_ATTITUDE]) worst += NAME(restore_length)(s->Q, 4, 1);
    it->statistics.correction = fmax(it->statistics.correction, (double)worst);
}
