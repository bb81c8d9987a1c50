/**
 * The rule: a pixel of ours is an outlier if one of its channels is less than the least of the 3 x 3 pixels around it in theirs by more than 3/255 of the range,
 * or more than the greatest by more than that.
 *
 * A picture is { size: [width, height], channels, greatest, data }: rows from above, `greatest` being the number that stands for 1.
 */

/** The greatest share of outliers that a picture may have. */
export const LIMIT = 0.001;

const TOLERANCE = 3 / 255;

/** How many outliers there are, how far the worst is out of the range (of 1), and a mask with 1 for each. */
export function judge(ours, theirs) {
    const { size: [width, height], channels, greatest } = theirs;
    if (String(ours.size) !== String(theirs.size) || ours.channels !== channels || ours.greatest !== greatest) {
        throw new Error('the two pictures are not of one kind');
    }
    const mask = new Uint8Array(width * height);
    let outliers = 0, worst = 0, same = 0;
    for (let y = 0; y < height; y++) {
        for (let x = 0; x < width; x++) {
            const pixel = y * width + x;
            let out = 0, differs = false;
            for (let channel = 0; channel < channels; channel++) {
                let least = Infinity, most = -Infinity;
                for (let ny = Math.max(y - 1, 0); ny <= Math.min(y + 1, height - 1); ny++) {
                    for (let nx = Math.max(x - 1, 0); nx <= Math.min(x + 1, width - 1); nx++) {
                        const value = theirs.data[(ny * width + nx) * channels + channel];
                        least = Math.min(least, value);
                        most = Math.max(most, value);
                    }
                }
                const value = ours.data[pixel * channels + channel];
                out = Math.max(out, least - value, value - most);
                differs ||= value !== theirs.data[pixel * channels + channel];
            }
            worst = Math.max(worst, out / greatest);
            same += differs ? 0 : 1;
            // In whole codes: 3/255 of 255 is 3, of 65535 it is 771.
            if (out > Math.round(TOLERANCE * greatest)) {
                mask[pixel] = 1;
                outliers++;
            }
        }
    }
    return { pixels: width * height, outliers, worst, same, mask };
}
