#include "panel_series.h"

static const double NODE[ORBIT_NODES] = {
    0.995,  0.6,     0.0,    -0.6,    -0.995, -0.8424, 0.8515, 0.2837,  -0.3352, 0.9424,
    -0.9418, 0.4464, -0.7224, -0.1655, 0.7477, -0.4747, 0.9765, -0.9764, 0.1489,  0.6773,
};

double panel_node(int node) {
    return NODE[node];
}

double panel_series_at(const PanelSeries *series, double x) {
    double sum = 0.0;
    for (int k = series->count - 1; k >= 0; k--) {
        sum = sum * (x - NODE[k]) + series->term[k];
    }
    return sum;
}

double panel_series_add(PanelSeries *series, double value) {
    double x = NODE[series->count], product = 1.0;
    double missed = value - panel_series_at(series, x);
    for (int k = 0; k < series->count; k++) {
        product *= x - NODE[k];
    }
    series->term[series->count++] = missed / product;
    return missed;
}

void panel_series_chebyshev(const PanelSeries *series, int side, double coefficient[ORBIT_NODES]) {
    double sum[ORBIT_NODES + 1] = {0.0};
    for (int k = series->count - 1; k >= 0; k--) {
        /* x T_0 = T_1, and x T_j = (T_(j+1) + T_(j-1)) / 2. */
        double next[ORBIT_NODES + 1] = {0.0};
        int degree = series->count - 1 - k;
        next[1] = sum[0];
        for (int j = 1; j < degree; j++) {
            next[j - 1] += 0.5 * sum[j];
            next[j + 1] += 0.5 * sum[j];
        }
        for (int j = 0; j <= degree; j++) {
            sum[j] = next[j] - NODE[k] * sum[j];
        }
        sum[0] += series->term[k];
    }
    for (int k = 0; k < ORBIT_NODES; k++) {
        coefficient[k] = (side < 0 && k % 2 == 1 ? -1.0 : 1.0) * sum[k];
    }
}
