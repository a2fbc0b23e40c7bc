"""A rough conductor for Mitsuba whose shadowing and masking are height-correlated, as tracer's and pbrt's are; Mitsuba's own
takes the product of two G1, which is darker at grazing angles."""

import drjit as dr
import mitsuba as mi


class CorrelatedConductor(mi.BSDF):
    """GGX (Walter et al. 2007), G2 of Heitz 2014, eq. 99, Fresnel's formula for metals; `alpha`, `eta` and `k` as `roughconductor` has them."""

    def __init__(self, props):
        mi.BSDF.__init__(self, props)
        self.alpha = props["alpha"]
        self.index = [[props[f"{name}_{c}"] for c in "rgb"] for name in ("eta", "k")]
        self.m_flags = mi.BSDFFlags.GlossyReflection | mi.BSDFFlags.FrontSide
        self.m_components = [self.m_flags]

    def fresnel(self, cos):
        channels = []
        for eta, k in zip(*self.index):
            sin2 = 1 - cos * cos
            t = eta * eta - k * k - sin2
            ab = dr.sqrt(t * t + 4 * eta * eta * k * k)
            a = dr.sqrt(dr.maximum(0.5 * (ab + t), 0))
            s = (ab + cos * cos - 2 * a * cos) / (ab + cos * cos + 2 * a * cos)
            p = s * (cos * cos * ab + sin2 * sin2 - 2 * a * cos * sin2) / (cos * cos * ab + sin2 * sin2 + 2 * a * cos * sin2)
            channels.append(0.5 * (s + p))
        return mi.Color3f(*channels)

    def heights(self, w):
        """Smith's Lambda (Heitz 2014, eq. 72)."""
        tan2 = (w.x * w.x + w.y * w.y) / (w.z * w.z)
        return 0.5 * (dr.sqrt(1 + self.alpha * self.alpha * tan2) - 1)

    def distribution(self):
        return mi.MicrofacetDistribution(mi.MicrofacetType.GGX, self.alpha, True)

    def eval(self, ctx, si, wo, active=True):
        active &= (si.wi.z > 0) & (wo.z > 0)
        h = dr.normalize(si.wi + wo)
        once = self.distribution().eval(h) / (4 * si.wi.z * (1 + self.heights(si.wi) + self.heights(wo)))
        return dr.select(active, self.fresnel(dr.dot(si.wi, h)) * once, 0)

    def pdf(self, ctx, si, wo, active=True):
        active &= (si.wi.z > 0) & (wo.z > 0)
        h = dr.normalize(si.wi + wo)
        return dr.select(active, self.distribution().pdf(si.wi, h) / (4 * dr.dot(wo, h)), 0)

    def eval_pdf(self, ctx, si, wo, active=True):
        return self.eval(ctx, si, wo, active), self.pdf(ctx, si, wo, active)

    def sample(self, ctx, si, sample1, sample2, active=True):
        h, _ = self.distribution().sample(si.wi, sample2)
        sample = mi.BSDFSample3f()
        sample.wo = mi.reflect(si.wi, h)
        active &= (si.wi.z > 0) & (sample.wo.z > 0)
        sample.pdf = self.pdf(ctx, si, sample.wo, active)
        sample.eta = 1.0
        sample.sampled_type = mi.UInt32(+mi.BSDFFlags.GlossyReflection)
        sample.sampled_component = 0
        weight = self.eval(ctx, si, sample.wo, active) / sample.pdf
        return sample, dr.select(active & (sample.pdf > 0), weight, 0)


def register():
    mi.register_bsdf("correlatedconductor", CorrelatedConductor)


def of(alpha, eta, k):
    index = {f"{name}_{c}": float(x) for name, values in (("eta", eta), ("k", k)) for c, x in zip("rgb", values)}
    return {"type": "correlatedconductor", "alpha": alpha, **index}
