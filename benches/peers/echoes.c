/* The sum of echoes as a textbook has it, in C: the peer of the method `stable`.
 *
 * Rigid mass on a fixed bar, mu = 1, D = 2: f(T) = sum over k D <= T of phi_k(T - k D) with
 * phi_k(x) = exp(-x) L_k(2x), and (j+1) L_{j+1}(X) = (2j+1 - X) L_j(X) - j L_{j-1}(X). Delays are
 * rounded and nothing is carried apart, so it loses digits that `stable` keeps; it is here for its
 * speed. `scalar` takes one point after the other, `blocked` 64 at once, for the compiler to make
 * vectors of.
 *
 *     cc -std=c11 -O3 -march=native -ffast-math -mprefer-vector-width=512 echoes.c -lm -o echoes
 *     ./echoes
 *
 * The width is GCC's option for machines with AVX-512; others ignore it or leave it out.
 *
 * Seconds are those of the thread, so that other processes do not count. Cycles come from a chain of
 * dependent operations that is timed beside each run, six cycles a round.
 */
#define _POSIX_C_SOURCE 199309L
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum { POINTS = 4096, BLOCK = 64, MOST = 256, ROUNDS = 15 };

/* L_{j+1} = (first[j] - third[j] X) L_j - second[j] L_{j-1}. */
static double first[MOST], second[MOST], third[MOST];
static double times[POINTS], values[POINTS], check[POINTS];

static double scalar_at(double time, int last)
{
    double sum = 0.0;
    for (int k = 0; k <= last && 2.0 * k <= time; k++) {
        double x = time - 2.0 * k, argument = 2.0 * x;
        double before = 0.0, value = 1.0;
        for (int j = 0; j < k; j++) {
            double next = (first[j] - third[j] * argument) * value - second[j] * before;
            before = value;
            value = next;
        }
        sum += exp(-x) * value;
    }
    return sum;
}

static void scalar(int last)
{
    for (int i = 0; i < POINTS; i++)
        values[i] = scalar_at(times[i], last);
}

/* All points lie behind the last arrival; one exponential a point serves all echoes. */
static void blocked(int last)
{
    for (int start = 0; start < POINTS; start += BLOCK) {
        double sum[BLOCK], decay[BLOCK];
        for (int i = 0; i < BLOCK; i++) {
            sum[i] = 0.0;
            decay[i] = exp(-(times[start + i] - 2.0 * last));
        }
        for (int k = 0; k <= last; k++) {
            double argument[BLOCK], before[BLOCK], value[BLOCK];
            for (int i = 0; i < BLOCK; i++) {
                argument[i] = 2.0 * (times[start + i] - 2.0 * k);
                before[i] = 0.0;
                value[i] = 1.0;
            }
            for (int j = 0; j < k; j++) {
                for (int i = 0; i < BLOCK; i++) {
                    double factor = first[j] - third[j] * argument[i];
                    double next = factor * value[i] - second[j] * before[i];
                    before[i] = value[i];
                    value[i] = next;
                }
            }
            double weight = exp(-2.0 * (last - k));
            for (int i = 0; i < BLOCK; i++)
                sum[i] += weight * decay[i] * value[i];
        }
        for (int i = 0; i < BLOCK; i++)
            values[start + i] = sum[i];
    }
}

static double seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* Cycles a second, at this moment. */
static double clock_rate(void)
{
    enum { STEPS = 100000 };
    static volatile uint64_t kept = 88172645463325252u;
    uint64_t state = kept;
    double start = seconds();
    for (int i = 0; i < STEPS; i++) {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
    }
    kept = state;
    return STEPS * 6.0 / (seconds() - start);
}

static int ascending(const void *a, const void *b)
{
    double difference = *(const double *)a - *(const double *)b;
    return (difference > 0.0) - (difference < 0.0);
}

static void measure(const char *name, void (*fill)(int), int last)
{
    double cycles[ROUNDS], rates[ROUNDS];
    fill(last);
    for (int round = 0; round < ROUNDS; round++) {
        double clock = clock_rate(), start = seconds();
        int count = 0;
        while (count == 0 || seconds() - start < 0.02) {
            fill(last);
            count++;
        }
        double each = (seconds() - start) / ((double)count * POINTS);
        cycles[round] = each * 0.5 * (clock + clock_rate());
        rates[round] = 1.0 / each;
    }
    qsort(cycles, ROUNDS, sizeof *cycles, ascending);
    qsort(rates, ROUNDS, sizeof *rates, ascending);
    printf("%-8s n = %3d %9.2f cycles a value, %9.2e values a second\n", name, last,
           cycles[ROUNDS / 2], rates[ROUNDS / 2]);
}

int main(void)
{
    const int lasts[] = {10, 200};
    for (int j = 0; j < MOST; j++) {
        first[j] = (2.0 * j + 1.0) / (j + 1.0);
        second[j] = j / (j + 1.0);
        third[j] = 1.0 / (j + 1.0);
    }
    for (int n = 0; n < 2; n++) {
        int last = lasts[n];
        for (int i = 0; i < POINTS; i++)
            times[i] = 2.0 * last + (i + 0.5) * (2.0 / POINTS);
        scalar(last);
        for (int i = 0; i < POINTS; i++)
            check[i] = values[i];
        blocked(last);
        double worst = 0.0;
        for (int i = 0; i < POINTS; i++)
            worst = fmax(worst, fabs(values[i] - check[i]));
        if (!(worst < 1e-9)) {
            fprintf(stderr, "scalar and blocked differ by %g at n = %d\n", worst, last);
            return 1;
        }
        measure("scalar", scalar, last);
        measure("blocked", blocked, last);
    }
    return 0;
}
