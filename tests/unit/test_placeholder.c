/*
 * test_placeholder.c - the fear: a formula of the paper is off by one building or by one factor.
 */
#include "check.h"
#include "placeholder.h"
#include "random.h"

#include <float.h>
#include <math.h>

#define NEAR(value, expected)                                                                               \
	CHECK(fabs((value) - (expected)) <= 1e-12 * fabs(expected), "%.17g instead of %.17g", (double) (value), \
		  (double) (expected))

static ty_parameters
defaults(double scale)
{
	ty_parameters p = {0};

	p.scale = scale;
	p.source_scale = TY_DEFAULT_SOURCE_SCALE;
	p.lod200_scale = TY_DEFAULT_LOD200_SCALE;
	p.exponent = TY_DEFAULT_EXPONENT;
	p.psi = TY_DEFAULT_PSI;
	p.law = true;
	return p;
}

static void
check_count(size_t n, double scale, double exponent, size_t expected)
{
	ty_parameters p = defaults(scale);
	size_t count;

	p.exponent = exponent;
	count = ty_count(n, &p, 300);
	CHECK(count == expected, "%zu at %g, exponent %g: %zu instead of %zu", n, scale, exponent, count, expected);
}

static void
forty_one_buildings_as_in_the_papers_figures(void)
{
	static const double scales[] = {25000, 50000, 75000, 100000, 200000};
	static const size_t squared[] = {41, 20, 13, 10, 5};
	static const size_t printed[] = {41, 28, 23, 20, 14};

	for (size_t i = 0; i < 5; i++)
	{
		check_count(41, scales[i], 2, squared[i]);
		check_count(41, scales[i], 1, printed[i]);
		check_count(41, scales[i], 0, 41);
	}
}

static void
whole_quotients_are_not_lost_to_rounding(void)
{
	/* n * (1 / 3) comes out a bit below a whole number for some n */
	for (size_t n = 3; n <= 30000; n += 3)
	{
		check_count(n, 75000, 2, n / 3);
		check_count(n, 150000, 2, n / 6 > 0 ? n / 6 : 1);
	}
	check_count(17717, 75000, 2, 5905);
	check_count(10000, 100000, 1, 5000);
	check_count(300, 225000.0 / 3, 2, 100);
}

static void
at_least_one_and_at_most_all(void)
{
	check_count(0, 50000, 2, 0);
	check_count(1, 200000, 2, 1);
	check_count(2, 200000, 100, 1);
	check_count(7, 25000, 2, 7);
	check_count(7, 1e300, 2, 1);
	check_count(1000000000, 50000, 2, 500000000);
}

static void
beyond_the_coarse_scale_the_exponent_is_at_least_four(void)
{
	/* to m200: * 1/8; from there to twice: * 1/4 for exponents up to 4, * 1/8 for 6 */
	check_count(3200, 400000, 2, 100);
	check_count(3200, 800000, 2, 25);
	check_count(3200, 400000, 0, 800);
	check_count(51200, 400000, 4, 200);
	check_count(4096, 400000, 6, 1);
	check_count(40960, 400000, 6, 10);
	check_count(3200, 200000, 2, 400);
}

static void
an_explicit_count_goes_before_the_law(void)
{
	ty_parameters p = defaults(100000);

	p.count = 17;
	CHECK(ty_count(41, &p, 300) == 17, "%zu", ty_count(41, &p, 300));
	CHECK(ty_count(5, &p, 300) == 5, "more than there are: %zu", ty_count(5, &p, 300));
	CHECK(ty_count(0, &p, 300) == 0, "of none: %zu", ty_count(0, &p, 300));
	p.count = INT64_MAX;
	CHECK(ty_count(5, &p, 300) == 5, "far more than there are: %zu", ty_count(5, &p, 300));
}

static void
black_white_count_never_grows_with_the_scale(void)
{
	for (double psi = -3; psi <= 1; psi += 0.25)
	{
		size_t before = 10000;

		for (double scale = 25000; scale < 900000; scale *= 1.03)
		{
			ty_parameters p = defaults(scale);
			size_t count;

			p.psi = psi;
			p.count_rule = TY_BLACK_WHITE;
			count = ty_count(10000, &p, 300);
			CHECK(count <= before && count >= 1, "psi %g, scale %g: %zu after %zu", psi, scale, count, before);
			before = count;
		}
	}
}

static void
black_white_count_is_the_inverse_of_the_largest_growth(void)
{
	ty_parameters p = defaults(50000);
	double largest = 0;

	p.count_rule = TY_BLACK_WHITE;
	CHECK(ty_count(1000, &p, 0) == 1000, "areas 0: %zu", ty_count(1000, &p, 0));
	NEAR(ty_area_factor(&p), 4 * (1 - 0.75 / 7));
	CHECK(ty_count(1000, &p, 300) == 280, "1000 / (4 * 0.893): %zu", ty_count(1000, &p, 300));
	p.scale = p.source_scale;
	CHECK(ty_count(1000, &p, 300) == 1000, "at the source scale: %zu", ty_count(1000, &p, 300));
	/* psi 1: the factor rises, then falls to 0 at m200; the count stays where it was at the top */
	p.psi = 1;
	for (double scale = 25000; scale <= 200000; scale += 10)
	{
		p.scale = scale;
		largest = fmax(largest, ty_area_factor(&p));
	}
	p.scale = 200000;
	CHECK(ty_count(100000, &p, 300) == (size_t) (100000 / largest), "%zu, largest factor %g", ty_count(100000, &p, 300),
		  largest);
}

static void
area_factor_is_one_at_the_source_scale(void)
{
	for (double psi = -2; psi <= 1; psi += 0.125)
	{
		ty_parameters p = defaults(25000);

		p.psi = psi;
		CHECK(ty_area_factor(&p) == 1, "psi %g: %a", psi, ty_area_factor(&p));
	}
}

static void
calibrated_psi_gives_the_coarse_layers_mean_area(void)
{
	random_state random = random_seed(21);

	for (size_t i = 0; i < 1000; i++)
	{
		double placeholder = 10 + 1000 * random_unit(&random);
		double coarse = 10 + 10000 * random_unit(&random);
		ty_parameters p = defaults(200000);

		p.psi = ty_psi(placeholder, coarse, p.source_scale, p.lod200_scale);
		NEAR(placeholder * ty_area_factor(&p), coarse);
		CHECK(p.psi <= 1, "psi %g", p.psi);
	}
	NEAR(ty_psi(306.25, 4900, 25000, 200000), 0.75);
	NEAR(ty_psi(1, 0, 25000, 200000), 1.0);
}

static void
area_factor_between_and_beyond(void)
{
	ty_parameters p = defaults(200000);

	NEAR(ty_area_factor(&p), 64 * 0.25);
	p.psi = 0;
	NEAR(ty_area_factor(&p), 64.0);
	p.psi = 0.7;
	p.scale = 112500;
	NEAR(ty_area_factor(&p), 20.25 * 0.65);
	/* beyond m200 a placeholder keeps its size on the map */
	p.scale = 400000;
	NEAR(ty_area_factor(&p), 256 * 0.3);
	p.psi = 1;
	CHECK(ty_area_factor(&p) == 0, "%g", ty_area_factor(&p));
}

static double
distance(ty_point a, ty_point b)
{
	return hypot(a.x - b.x, a.y - b.y);
}

static void
check_ring(ty_point center, double area, double ratio, double degrees)
{
	ty_point ring[5];
	double ux, uy, width, length, shoelace = 0, turned;

	ty_direction(degrees, &ux, &uy);
	ty_rectangle(center, area, ratio, ux, uy, ring);
	ty_rectangle_sides(area, ratio, &width, &length);
	for (size_t i = 0; i < 4; i++)
	{
		ty_point a = {ring[i].x - center.x, ring[i].y - center.y};
		ty_point b = {ring[i + 1].x - center.x, ring[i + 1].y - center.y};

		shoelace += (a.x * b.y - b.x * a.y) / 2;
	}
	CHECK(memcmp(&ring[0], &ring[4], sizeof *ring) == 0, "%g %g: not closed", area, ratio);
	CHECK(fabs(shoelace - area) <= 1e-6 * area, "area %.17g instead of %.17g", shoelace, area);
	CHECK(fabs(width * length - area) <= 1e-12 * area && width <= length * (1 + 1e-15), "sides %g %g, area %g", width,
		  length, area);
	CHECK(fabs(width - ratio * length) <= 1e-12 * length, "sides %g %g, ratio %g", width, length, ratio);
	CHECK(fabs(fmax(distance(ring[0], ring[1]), distance(ring[1], ring[2])) - length) <= 1e-6 * length, "length %g",
		  length);
	turned = fabs((ring[0].x + ring[2].x) / 2 - center.x) + fabs((ring[1].y + ring[3].y) / 2 - center.y);
	CHECK(turned <= 1e-9 * (1 + fabs(center.x) + fabs(center.y)), "not centred: off by %g", turned);
}

static void
rectangles_have_their_area_sides_and_centre(void)
{
	random_state random = random_seed(22);

	for (size_t i = 0; i < 20000; i++)
	{
		ty_point center = {4e6 * random_unit(&random), 6e6 * random_unit(&random) - 3e6};
		double ratio = i % 5 == 0 ? 1 : 0.01 + 0.99 * random_unit(&random);

		check_ring(center, 1 + 5000 * random_unit(&random), ratio, 360 * random_unit(&random));
	}
}

static void
the_longer_side_has_the_direction(void)
{
	ty_point center = {10, 20};
	ty_point ring[5];
	double along = 0;

	ty_rectangle(center, 200, 0.5, 0.6, 0.8, ring); /* 20 by 10 */
	for (size_t i = 0; i < 4; i++)
	{
		double x = ring[i + 1].x - ring[i].x;
		double y = ring[i + 1].y - ring[i].y;

		if (fabs(fabs(x * 0.6 + y * 0.8) - 20) < 1e-9)
			along++;
		else
			CHECK(fabs(fabs(y * 0.6 - x * 0.8) - 10) < 1e-9, "side %zu: %g %g", i, x, y);
	}
	CHECK(along == 2, "%g sides have the direction", along);
}

static void
no_area_gives_no_sides_and_no_nan(void)
{
	double width = NAN, length = NAN;
	ty_point ring[5];

	ty_rectangle_sides(0, 1, &width, &length);
	CHECK(width == 0 && length == 0, "%g %g", width, length);
	ty_rectangle_sides(0, 0.25, &width, &length);
	CHECK(width == 0 && length == 0, "%g %g", width, length);
	ty_rectangle_sides(DBL_MAX, 1e-300, &width, &length);
	CHECK(!isnan(width) && !isnan(length), "%g %g", width, length);
	ty_rectangle((ty_point){3, 4}, 0, 1, 1, 0, ring);
	for (size_t i = 0; i < 5; i++)
		CHECK(ring[i].x == 3 && ring[i].y == 4, "corner %zu at %g %g", i, ring[i].x, ring[i].y);
}

static void
orientation_lies_in_zero_to_180(void)
{
	for (int degrees = -720; degrees <= 720; degrees++)
	{
		double ux, uy, back;
		double expected = (degrees % 180 + 180) % 180;

		ty_direction(degrees, &ux, &uy);
		back = ty_orientation_degrees(ux, uy);
		CHECK(uy > 0 || (uy == 0 && ux == 1), "%d: direction %a %a", degrees, ux, uy);
		CHECK(back >= 0 && back < 180, "%d came back as %.17g", degrees, back);
		CHECK(fabs(back - expected) < 1e-9, "%d came back as %.17g", degrees, back);
		CHECK(fabs(hypot(ux, uy) - 1) < 1e-14, "%d: length %.17g", degrees, hypot(ux, uy));
	}
	CHECK(ty_orientation_degrees(1, 0) == 0 && ty_orientation_degrees(0, 1) == 90, "right angles");
	CHECK(ty_orientation_degrees(-1, 1e-300) < 180, "almost 180: %.17g", ty_orientation_degrees(-1, 1e-300));
}

static void
directions_just_off_the_axis_stay_in_range(void)
{
	static const double nearly[] = {-1e-300, -1e-15, 1e-300, 180 - 1e-14, 180 + 1e-14, 359.99999999999994, 1e15};

	for (size_t i = 0; i < sizeof nearly / sizeof *nearly; i++)
	{
		double ux, uy;

		ty_direction(nearly[i], &ux, &uy);
		CHECK(uy > 0 || (uy == 0 && ux == 1), "%g: direction %a %a", nearly[i], ux, uy);
		CHECK(ty_orientation_degrees(ux, uy) < 180, "%g came back as %.17g", nearly[i], ty_orientation_degrees(ux, uy));
	}
}

static ty_parameters
legible(double min_side, double max_area)
{
	ty_parameters p = defaults(100000);

	p.min_side = min_side;
	p.max_area = max_area;
	return p;
}

static void
check_size(const ty_parameters *p, double statistic, double area, double ratio, size_t members, double width,
		   double length)
{
	ty_size size = ty_drawn_size(p, statistic, area, ratio, members);

	CHECK(fabs(size.width - width) <= 1e-12 * width && fabs(size.length - length) <= 1e-12 * length,
		  "%g of %g, ratio %g, %zu members: %.17g by %.17g instead of %.17g by %.17g", area, statistic, ratio, members,
		  size.width, size.length, width, length);
	NEAR(size.area, width * length);
	NEAR(size.ratio, length > 0 ? width / length : 1.0);
}

static void
without_limits_a_size_is_area_and_ratio(void)
{
	ty_parameters p = defaults(100000);

	check_size(&p, 100, 400, 1, 1, 20, 20);
	check_size(&p, 100, 400, 0.25, 5, 10, 40);
	check_size(&p, 0, 0, 1, 5, 0, 0);
}

static void
the_short_side_is_enlarged_and_not_all_turns_square(void)
{
	ty_parameters p = legible(10, 0);

	check_size(&p, 25, 200, 0.5, 1, 10, 20);
	check_size(&p, 25, 25, 1, 1, 10, 10);				/* a square stays one */
	check_size(&p, 25, 25, 0.8, 1, 10, 12.5);			/* 1 / ratio */
	check_size(&p, 25, 25, 0.25, 1, 10, 15);			/* 1.5 at most */
	check_size(&p, 25, 100, 0.0625, 1, 10, 40);			/* a long side that is longer stays: 2.5 by 40 */
	check_size(&p, 0, 0, 1, 1, 10, 10);					/* points */
	check_size(&p, 25, 300, 0.1, 2, 10, sqrt(300 * 3)); /* several: the ratio is held at 1/3 */
	check_size(&p, 25, 4800, 1.0 / 3, 2, 40, 120);
	check_size(&p, 25, 1600, 0.25, 1, 20, 80);
}

static void
nothing_is_enlarged_beyond_max_area(void)
{
	ty_parameters p = legible(10, 200), off = legible(0, 200);

	check_size(&p, 100, 900, 1, 1, sqrt(200), sqrt(200)); /* grown to the limit */
	check_size(&p, 100, 144, 1, 3, 12, 12);				  /* below it: A_n */
	check_size(&p, 400, 3600, 1, 1, 20, 20);			  /* large by itself: its own size */
	check_size(&p, 400, 100, 1, 1, 20, 20);				  /* not even smaller, when sizes are drawn smaller */
	check_size(&off, 100, 900, 1, 1, sqrt(200), sqrt(200));
	check_size(&p, 64, 900, 0.01, 1, 10, 20); /* a long thin one is enlarged to the limit, not beyond */
	check_size(&p, 400, 900, 0.01, 1, 10, 40);
}

static void
lengths_on_the_map_become_ground_units(void)
{
	ty_parameters metres = legible(0.35, 0.245), feet = metres, none = defaults(50000);

	ty_bring_to_ground(&metres, 1);
	NEAR(metres.min_side, 35.0);
	NEAR(metres.max_area, 2450.0);
	ty_bring_to_ground(&feet, 0.3048);
	NEAR(feet.min_side, 35 / 0.3048);
	NEAR(feet.max_area, 2450 / 0.3048 / 0.3048);
	ty_bring_to_ground(&none, 0.3048);
	CHECK(none.min_side == 0 && none.max_area == 0, "%g, %g", none.min_side, none.max_area);
}

static void
the_plain_sum_is_not_scaled(void)
{
	ty_parameters p = defaults(100000);

	NEAR(ty_scaled_area(&p, 7, 3), 21.0);
	p.area_statistic = TY_MEDIAN;
	NEAR(ty_scaled_area(&p, 7, 3), 21.0);
	p.area_statistic = TY_SUM;
	NEAR(ty_scaled_area(&p, 7, 3), 3.0);
}

int
main(int argc, char **argv)
{
	check_begin(argc, argv);
	RUN(forty_one_buildings_as_in_the_papers_figures);
	RUN(whole_quotients_are_not_lost_to_rounding);
	RUN(at_least_one_and_at_most_all);
	RUN(beyond_the_coarse_scale_the_exponent_is_at_least_four);
	RUN(an_explicit_count_goes_before_the_law);
	RUN(black_white_count_never_grows_with_the_scale);
	RUN(black_white_count_is_the_inverse_of_the_largest_growth);
	RUN(area_factor_is_one_at_the_source_scale);
	RUN(calibrated_psi_gives_the_coarse_layers_mean_area);
	RUN(area_factor_between_and_beyond);
	RUN(rectangles_have_their_area_sides_and_centre);
	RUN(the_longer_side_has_the_direction);
	RUN(no_area_gives_no_sides_and_no_nan);
	RUN(orientation_lies_in_zero_to_180);
	RUN(directions_just_off_the_axis_stay_in_range);
	RUN(without_limits_a_size_is_area_and_ratio);
	RUN(the_short_side_is_enlarged_and_not_all_turns_square);
	RUN(nothing_is_enlarged_beyond_max_area);
	RUN(lengths_on_the_map_become_ground_units);
	RUN(the_plain_sum_is_not_scaled);
	return check_end();
}
