/* test_kernel.c - kernel and equation of state against their definitions.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../test.h"

#include "../../../sph/pairs/kernel.h"
#include "../../../sph/particles/eos.h"

/* Gauss-Legendre of three points on each of n intervals: exact for the kernel's polynomial on one.
 */
static double integral(int dim, double R)
{
    static const double at[3] = {-0.7745966692414834, 0.0, 0.7745966692414834};
    static const double weight[3] = {5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};
    const int n = 200;
    double sum = 0.0;
    for (int k = 0; k < n; k++)
        for (int g = 0; g < 3; g++) {
            const double r = R * (k + 0.5 + 0.5 * at[g]) / n;
            const double shell = dim == 2 ? 2.0 * M_PI * r : 4.0 * M_PI * r * r;
            sum += weight[g] * R / n * shell * kernel_w(dim, r, R);
        }
    return sum;
}

TEST(integrates_to_one)
{
    for (int dim = 2; dim <= 3; dim++) {
        assert_close(integral(dim, 0.3), 1.0, 1e-12);
        assert_close(integral(dim, 7.0), 1.0, 1e-12);
    }
}

TEST(slope_is_the_derivative)
{
    const double R = 0.3, e = 1e-6;
    for (int dim = 2; dim <= 3; dim++)
        for (double r = 0.01; r < 0.33; r += 0.01) {
            const double slope = (kernel_w(dim, r + e, R) - kernel_w(dim, r - e, R)) / (2.0 * e);
            assert_close(kernel_dw_r(dim, r, R) * r, slope, 1e-6 * kernel_w0(dim, R) / R);
        }
}

TEST(ends_at_its_support)
{
    for (int dim = 2; dim <= 3; dim++) {
        assert_true(kernel_w(dim, 0.3, 0.3) == 0.0 && kernel_dw_r(dim, 0.3, 0.3) == 0.0);
        assert_true(kernel_w(dim, 1e15, 0.3) == 0.0 && kernel_dw_r(dim, 1e15, 0.3) == 0.0);
        assert_close(kernel_w(dim, 0.0, 0.3), kernel_w0(dim, 0.3), 1e-12);
        assert_true(kernel_dw_r(dim, 0.0, 0.3) < 0.0);
    }
}

TEST(sound_speed_is_the_slope_of_pressure)
{
    const double rho0 = 1000.0, c0 = 20.0, e = 1e-3;
    for (double gamma = 1.0; gamma <= 7.0; gamma += 6.0)
        for (double rho = 950.0; rho <= 1050.0; rho += 10.0) {
            const double slope =
                (eos_p(rho + e, rho0, c0, gamma) - eos_p(rho - e, rho0, c0, gamma)) / (2.0 * e);
            const double c = eos_c(rho, rho0, c0, gamma);
            assert_close(c * c, slope, 1e-5 * slope);
            assert_close(eos_rho(eos_p(rho, rho0, c0, gamma), rho0, c0, gamma), rho, 1e-9);
        }
    assert_close(eos_p(rho0, rho0, c0, 7.0), 0.0, 1e-9);
    assert_close(eos_c(rho0, rho0, c0, 7.0), c0, 1e-12);
}

TEST(pressure_without_density_is_held)
{
    const double rho = eos_rho(-1e9, 1000.0, 20.0, 7.0);
    assert_true(rho > 0.0 && rho < 500.0);
}
