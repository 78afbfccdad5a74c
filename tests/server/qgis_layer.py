"""qgis_layer.py PROVIDER SOURCE PNG - opens a layer in QGIS without a screen, prints what QGIS makes of it, one value a
line, and renders it black on white. Exit status 77: there is no QGIS here."""

import os
import sys

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
try:
    from qgis.core import (Qgis, QgsApplication, QgsFillSymbol, QgsGeometry, QgsMapRendererParallelJob,
                           QgsMapSettings, QgsSingleSymbolRenderer, QgsVectorLayer, QgsWkbTypes)
    from qgis.PyQt.QtCore import QSize
    from qgis.PyQt.QtGui import QColor, QImage
except ImportError:
    sys.exit(77)

WIDTH, HEIGHT = 1000, 750


def describe(layer):
    provider = layer.dataProvider()
    features = list(layer.getFeatures())
    keys = [layer.fields()[i].name() for i in layer.primaryKeyAttributes()]
    values = {tuple(feature[key] for key in keys) for feature in features}
    print("features", layer.featureCount())
    print("read", len(features))
    print("geometry", QgsWkbTypes.displayString(layer.wkbType()))
    print("srid", layer.crs().postgisSrid())
    print("key", " ".join(keys) or "none")
    print("distinct keys", len(values) if keys else 0)
    print("invalid", sum(not feature.geometry().isGeosValid() for feature in features if feature.hasGeometry()))
    print("spatial index", "yes" if provider.hasSpatialIndex() == 2 else "no")
    return features


def render(layer, features, path):
    """Prints the share of dark pixels, and the share that the polygons have in what is shown, in percent."""
    layer.setRenderer(QgsSingleSymbolRenderer(QgsFillSymbol.createSimple({"color": "black", "outline_style": "no"})))
    extent = layer.extent()
    extent.scale(1.05)
    settings = QgsMapSettings()
    settings.setLayers([layer])
    settings.setDestinationCrs(layer.crs())
    settings.setBackgroundColor(QColor("white"))
    settings.setOutputSize(QSize(WIDTH, HEIGHT))
    settings.setExtent(extent)
    job = QgsMapRendererParallelJob(settings)
    job.start()
    job.waitForFinished()
    image = job.renderedImage().convertToFormat(QImage.Format_Grayscale8)
    image.save(path)
    dark = sum(255 - image.pixelColor(x, y).lightness() for x in range(WIDTH) for y in range(HEIGHT)) / 255
    shown = settings.visibleExtent()
    print("dark", round(100 * dark / (WIDTH * HEIGHT), 2))
    built = QgsGeometry.unaryUnion([f.geometry() for f in features if f.hasGeometry()]).area()
    print("built", round(100 * built / (shown.width() * shown.height()), 2))


def main():
    provider, source, path = sys.argv[1:]
    application = QgsApplication([], False)
    application.initQgis()
    print("QGIS", Qgis.QGIS_VERSION.split("-")[0])
    layer = QgsVectorLayer(source, "layer", provider)
    if not layer.isValid():
        sys.exit("not a valid layer: %s: %s" % (source, layer.error().message() or "QGIS gives no reason"))
    render(layer, describe(layer), path)
    del layer
    application.exitQgis()


main()
