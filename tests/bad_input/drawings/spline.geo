Point(1) = {0, 0, 0};
Point(2) = {1, 0, 0};
Spline(1) = {1, 2};
